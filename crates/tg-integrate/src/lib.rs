//! Time stepping of tensegrity structures: the modified symplectic scheme and generalised-alpha.

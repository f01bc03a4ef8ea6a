//! Sparse saddle-point systems of a fixed pattern: slot map, static-order LU, pivoting fallback.

//! A tensegrity structure: members, joints, cables, supports, loads and signals, offered to the solvers as flat slices.

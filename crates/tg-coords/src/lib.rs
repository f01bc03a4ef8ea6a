//! Natural coordinates of one rigid member: types, weights of points, intrinsic constraints, scalar mass.

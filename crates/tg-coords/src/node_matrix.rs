//! Scalar nodes × nodes matrices, each standing for its Kronecker product with I_D.

use nalgebra::SVector;

use crate::coord_type::MAX_NODES;

/// Scalar matrix S over the nodes of a member; the matrix over coordinates is `S ⊗ I_D`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeMatrix {
    entries: [[f64; MAX_NODES]; MAX_NODES],
    len: usize,
}

impl NodeMatrix {
    /// Matrix with entries `entry(row, column)`.
    pub(crate) fn from_fn(len: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        debug_assert!(len <= MAX_NODES);
        let mut entries = [[0.0; MAX_NODES]; MAX_NODES];
        for (i, row) in entries.iter_mut().take(len).enumerate() {
            for (j, value) in row.iter_mut().take(len).enumerate() {
                *value = entry(i, j);
            }
        }
        Self { entries, len }
    }

    /// Entry in row `i`, column `j`.
    ///
    /// # Panics
    /// Unless both are below [`len`](Self::len).
    #[track_caller]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        assert!(i < self.len && j < self.len, "({i}, {j}) of {}", self.len);
        self.entries[i][j]
    }

    /// Number of rows, the number of nodes of the member.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the matrix has no rows; never so for a member, which has at least one node.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Row `i`.
    ///
    /// # Panics
    /// Unless `i` is below [`len`](Self::len).
    #[track_caller]
    pub fn row(&self, i: usize) -> &[f64] {
        assert!(i < self.len, "row {i} of {}", self.len);
        &self.entries[i][..self.len]
    }

    /// Bilinear form `aᵀ (S ⊗ I_D) b = Σ S_ij a_i·b_j`.
    ///
    /// # Panics
    /// Unless both lists have [`len`](Self::len) vectors.
    #[track_caller]
    pub fn form<const D: usize>(&self, a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
        assert_eq!(a.len(), self.len, "left vectors against rows");
        assert_eq!(b.len(), self.len, "right vectors against columns");
        let mut sum = 0.0;
        for (row, left) in self.entries.iter().zip(a) {
            for (&entry, right) in row.iter().zip(b) {
                sum += entry * left.dot(right);
            }
        }
        sum
    }

    /// Product `(S ⊗ I_D) v`, written to `out`.
    ///
    /// # Panics
    /// Unless both lists have [`len`](Self::len) vectors.
    #[track_caller]
    pub fn apply_into<const D: usize>(&self, v: &[SVector<f64, D>], out: &mut [SVector<f64, D>]) {
        assert_eq!(v.len(), self.len, "vectors against columns");
        assert_eq!(out.len(), self.len, "results against rows");
        for (row, result) in self.entries.iter().zip(out) {
            *result = SVector::zeros();
            for (&entry, vector) in row.iter().zip(v) {
                *result += vector * entry;
            }
        }
    }

    /// Whether a Cholesky factorisation exists with every pivot above `1e-12` of its diagonal entry.
    ///
    /// The mass matrix of a lamina in space or of a bar with all mass in one point fails: its
    /// kinetic energy of rigid motion is right, but it cannot be inverted by itself.
    pub fn is_positive_definite(&self) -> bool {
        let mut lower = [[0.0; MAX_NODES]; MAX_NODES];
        for i in 0..self.len {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
                let rest = self.entries[i][j] - known;
                if i != j {
                    lower[i][j] = rest / lower[j][j];
                } else if rest > 1e-12 * self.entries[i][i] {
                    lower[i][i] = rest.sqrt();
                } else {
                    return false;
                }
            }
        }
        true
    }

    /// `yᵀ S y` (eq. 18c).
    pub(crate) fn congruence(&self, y: &NodeMatrix) -> Self {
        Self::from_fn(self.len, |i, j| {
            let mut sum = 0.0;
            for k in 0..self.len {
                for l in 0..self.len {
                    sum += y.entries[k][i] * self.entries[k][l] * y.entries[l][j];
                }
            }
            sum
        })
    }

    /// Whether all entries are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.entries.iter().flatten().all(|entry| entry.is_finite())
    }
}

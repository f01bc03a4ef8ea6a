//! Elimination tree, column counts and postorder of a symmetric pattern (Liu 1990; Davis 2006, ch. 4).

use crate::order::Rows;

/// "No parent": the column is a root.
pub(crate) const NONE: u32 = u32::MAX;

/// Elimination tree of a symmetric pattern, relabelled so that it is postordered.
pub(crate) struct EliminationTree {
    /// New position → old position.
    pub(crate) postorder: Vec<u32>,
    /// Parent of each new position, or [`NONE`].
    pub(crate) parent: Vec<u32>,
    /// Entries of each column of `L` below the diagonal.
    pub(crate) count: Vec<u32>,
}

impl EliminationTree {
    /// `matrix` is symmetric; its diagonal need not be present.
    pub(crate) fn new(matrix: &Rows) -> Self {
        let parent = parents(matrix);
        let count = column_counts(matrix, &parent);
        let postorder = postorder(&parent, &count);
        let mut position = vec![0_u32; parent.len()];
        for (new, &old) in postorder.iter().enumerate() {
            position[old as usize] = new as u32;
        }
        let relabel = |old: u32| if old == NONE { NONE } else { position[old as usize] };
        Self {
            parent: postorder.iter().map(|&old| relabel(parent[old as usize])).collect(),
            count: postorder.iter().map(|&old| count[old as usize]).collect(),
            postorder,
        }
    }
}

fn parents(matrix: &Rows) -> Vec<u32> {
    let n = matrix.len();
    let mut parent = vec![NONE; n];
    let mut ancestor = vec![NONE; n];
    for i in 0..n {
        for &k in matrix.row(i) {
            let mut k = k as usize;
            while k < i {
                let next = ancestor[k];
                ancestor[k] = i as u32;
                if next == NONE {
                    parent[k] = i as u32;
                    break;
                }
                k = next as usize;
            }
        }
    }
    parent
}

/// Walks every row subtree: linear in the entries of `L`.
fn column_counts(matrix: &Rows, parent: &[u32]) -> Vec<u32> {
    let n = matrix.len();
    let mut count = vec![0_u32; n];
    let mut visited_by = vec![NONE; n];
    for i in 0..n {
        visited_by[i] = i as u32;
        for &k in matrix.row(i) {
            let mut k = k as usize;
            while k < i && visited_by[k] != i as u32 {
                visited_by[k] = i as u32;
                count[k] += 1;
                k = parent[k] as usize;
            }
        }
    }
    count
}

/// The child with the longest column comes last, which makes runs of columns with one pattern longer.
fn postorder(parent: &[u32], count: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let mut by_count: Vec<u32> = (0..n as u32).collect();
    by_count.sort_by_key(|&j| count[j as usize]);
    // Lists of children in descending order of count, headed by the longest.
    let mut head = vec![NONE; n + 1];
    let mut next = vec![NONE; n];
    for &j in &by_count {
        let p = parent[j as usize];
        let p = if p == NONE { n } else { p as usize };
        next[j as usize] = head[p];
        head[p] = j;
    }
    // Reverse preorder that visits the longest child first is the postorder that visits it last.
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::with_capacity(n);
    let mut root = head[n];
    while root != NONE {
        stack.push(root);
        root = next[root as usize];
    }
    stack.reverse();
    while let Some(j) = stack.pop() {
        order.push(j);
        let from = stack.len();
        let mut child = head[j as usize];
        while child != NONE {
            stack.push(child);
            child = next[child as usize];
        }
        stack[from..].reverse();
    }
    order.reverse();
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boolean elimination on a dense pattern: (parent, below-diagonal count) of each column.
    fn dense(n: usize, pairs: &[(u32, u32)]) -> Vec<(u32, u32)> {
        let mut a = vec![vec![false; n]; n];
        for &(i, j) in pairs {
            a[i as usize][j as usize] = true;
        }
        (0..n)
            .map(|k| {
                let below: Vec<usize> = (k + 1..n).filter(|&i| a[i][k]).collect();
                for &i in &below {
                    for &j in &below {
                        a[i][j] = true;
                    }
                }
                (below.first().map_or(NONE, |&p| p as u32), below.len() as u32)
            })
            .collect()
    }

    #[test]
    fn agrees_with_dense_elimination() {
        let mut seed = 1_u64;
        for n in [1_usize, 2, 7, 15, 30] {
            let mut pairs = Vec::new();
            for _ in 0..2 * n {
                seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                let (i, j) = ((seed >> 33) as usize % n, (seed >> 13) as usize % n);
                pairs.extend([(i as u32, j as u32), (j as u32, i as u32)]);
            }
            pairs.sort_unstable();
            pairs.dedup();
            let tree = EliminationTree::new(&Rows::from_sorted(n, &pairs));
            let mut position = vec![0; n];
            for (new, &old) in tree.postorder.iter().enumerate() {
                position[old as usize] = new as u32;
            }
            let moved: Vec<_> =
                pairs.iter().map(|&(i, j)| (position[i as usize], position[j as usize])).collect();
            let found: Vec<_> = tree.parent.iter().copied().zip(tree.count.iter().copied()).collect();
            assert_eq!(found, dense(n, &moved));
            // Postordered: the subtree of each column is a run that ends at it.
            let mut size = vec![1_u32; n];
            for j in 0..n {
                if tree.parent[j] != NONE {
                    assert!(tree.parent[j] > j as u32);
                    size[tree.parent[j] as usize] += size[j];
                }
            }
            for j in 0..n {
                let first = j + 1 - size[j] as usize;
                assert!((first..j).all(|k| tree.parent[k] <= j as u32));
            }
        }
    }
}

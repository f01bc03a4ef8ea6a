//! The assignment problem by the Hungarian method with potentials, O(n² m).

/// For each row a column of its own so that the sum of `gain[row][column]` is largest; at least as many columns as rows.
pub(crate) fn assign(gain: &[Vec<f64>]) -> Vec<usize> {
    let rows = gain.len();
    let columns = gain.first().map_or(0, Vec::len);
    debug_assert!(columns >= rows);
    // Row and column 0 are virtual: the row that is being placed starts from column 0.
    let (mut row_potential, mut column_potential) = (vec![0.0; rows + 1], vec![0.0; columns + 1]);
    let mut row_of = vec![0; columns + 1];
    for row in 1..=rows {
        row_of[0] = row;
        let mut column = 0;
        let mut slack = vec![f64::INFINITY; columns + 1];
        let mut came_from = vec![0; columns + 1];
        let mut done = vec![false; columns + 1];
        while row_of[column] != 0 {
            done[column] = true;
            let r = row_of[column];
            let (mut least, mut next) = (f64::INFINITY, 0);
            for c in 1..=columns {
                if done[c] {
                    continue;
                }
                let reduced = -gain[r - 1][c - 1] - row_potential[r] - column_potential[c];
                if reduced < slack[c] {
                    (slack[c], came_from[c]) = (reduced, column);
                }
                if slack[c] < least {
                    (least, next) = (slack[c], c);
                }
            }
            for c in 0..=columns {
                if done[c] {
                    row_potential[row_of[c]] += least;
                    column_potential[c] -= least;
                } else {
                    slack[c] -= least;
                }
            }
            column = next;
        }
        while column != 0 {
            row_of[column] = row_of[came_from[column]];
            column = came_from[column];
        }
    }
    let mut column_of = vec![0; rows];
    for c in 1..=columns {
        if row_of[c] != 0 {
            column_of[row_of[c] - 1] = c - 1;
        }
    }
    column_of
}

#[cfg(test)]
mod tests {
    use super::assign;

    fn best(gain: &[Vec<f64>], row: usize, used: &mut Vec<bool>) -> f64 {
        if row == gain.len() {
            return 0.0;
        }
        let mut most = f64::NEG_INFINITY;
        for c in 0..used.len() {
            if !used[c] {
                used[c] = true;
                most = most.max(gain[row][c] + best(gain, row + 1, used));
                used[c] = false;
            }
        }
        most
    }

    #[test]
    fn finds_what_trying_all_finds() {
        let mut x = 7_u64;
        let mut random = || {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (x >> 11) as f64 / (1_u64 << 53) as f64
        };
        for trial in 0..200 {
            let (rows, columns) = (1 + trial % 5, 1 + trial % 5 + trial % 3);
            let gain: Vec<Vec<f64>> = (0..rows).map(|_| (0..columns).map(|_| random()).collect()).collect();
            let assigned = assign(&gain);
            let sum: f64 = assigned.iter().enumerate().map(|(r, &c)| gain[r][c]).sum();
            let mut distinct = assigned.clone();
            distinct.sort_unstable();
            distinct.dedup();
            assert_eq!(distinct.len(), rows);
            assert!((sum - best(&gain, 0, &mut vec![false; columns])).abs() < 1e-14);
        }
    }
}

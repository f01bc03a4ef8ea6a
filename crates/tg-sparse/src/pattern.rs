//! The pattern of a saddle-point system, analysed once: elimination order, fronts, slots.
//!
//! `K = [H, −A₀ᵀ; A₁, 0]`, the Jacobian of the time-stepping scheme, eq. (55): `H = M̌ − h²/2 ∂F̌/∂q̌`, `A₀ = Ǎ(q_k)`,
//! `A₁ = Ǎ(q_{k+1})`.

use crate::error::{EntryList, Row, SparseError};
use crate::order::{Rows, elimination_order};
use crate::slot_map::SlotMap;
use crate::symbolic::Symbolic;

/// Pattern of a saddle-point system with everything that does not depend on values: static elimination order, fronts
/// of the factorisation, slots of the entries.
///
/// Immutable; a [`SaddleSystem`](crate::SaddleSystem) is made from a clone of it.
#[derive(Clone, Debug)]
pub struct SaddlePattern {
    pub(crate) n: usize,
    pub(crate) m: usize,
    pub(crate) slots: SlotMap,
    pub(crate) symbolic: Symbolic,
    /// (slot in the compressed rows, offset in the front's panel) of each entry, by front.
    pub(crate) assembly: Vec<(u32, u32)>,
    /// Where the list of each front starts in `assembly`; one more than fronts.
    pub(crate) assembly_start: Vec<usize>,
}

impl SaddlePattern {
    /// Analyses the pattern of a system of `n` unknowns and `m` multipliers.
    ///
    /// `leading` holds the entries (row, column) of `H` in one or more groups (mass, stiffness, damping), each with its
    /// own fixed order of entries; `jacobian` those of `A` as (constraint, unknown), shared by `A₀` and `A₁`. An entry
    /// may repeat: its values are summed. `None` stands for an entry outside of the system (at a prescribed
    /// coordinate): its values are skipped. `H` need not be given symmetrically; its pattern is made symmetric.
    ///
    /// # Errors
    /// [`SparseError::EntryOutside`], [`SparseError::FreeMultiplier`] for a constraint without any unknown,
    /// [`SparseError::TooLarge`] beyond 32-bit indices.
    pub fn new(
        n: usize,
        m: usize,
        leading: &[&[Option<(usize, usize)>]],
        jacobian: &[Option<(usize, usize)>],
    ) -> Result<Self, SparseError> {
        check_size("unknowns and multipliers", n.saturating_add(m))?;
        let mut pairs = Vec::new();
        for (group, list) in leading.iter().enumerate() {
            for pair in checked(list, EntryList::Leading(group), n, n) {
                let (row, column) = pair?;
                pairs.extend([(row, column), (column, row)]);
            }
        }
        let leading_rows = Rows::from_pairs(n, n, &pairs);
        drop(pairs);
        let pairs: Result<Vec<_>, _> = checked(jacobian, EntryList::Jacobian, m, n).collect();
        let jacobian_rows = Rows::from_pairs(m, n, &pairs?);
        if let Some(multiplier) = (0..m).find(|&j| jacobian_rows.row(j).is_empty()) {
            return Err(SparseError::FreeMultiplier { multiplier });
        }
        check_size("matrix entries", leading_rows.column().len() + 2 * jacobian_rows.column().len())?;

        let order = elimination_order(&leading_rows, &jacobian_rows)?;
        let symbolic = Symbolic::new(&saddle_rows(&leading_rows, &jacobian_rows, &inverse(&order)), &order);
        let position = inverse(&symbolic.order);
        let rows = saddle_rows(&leading_rows, &jacobian_rows, &position);
        let slots = SlotMap::new(n, rows, &position, leading, jacobian);
        let (assembly, assembly_start) = assemble_fronts(&symbolic, &slots.rows)?;
        Ok(Self { n, m, slots, symbolic, assembly, assembly_start })
    }

    /// n, the number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.n
    }

    /// m, the number of multipliers.
    #[must_use]
    pub fn multipliers(&self) -> usize {
        self.m
    }

    /// n + m, the order of the matrix.
    #[must_use]
    pub fn size(&self) -> usize {
        self.n + self.m
    }

    /// Number of entries of the matrix, both blocks of the Jacobian counted.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.slots.entries()
    }

    /// Number of entries of the factors L and U, the diagonal counted once. Includes the zeros that the solver stores
    /// to work on dense blocks.
    #[must_use]
    pub fn factor_entries(&self) -> usize {
        self.symbolic.factor_entries
    }

    /// Number of multiplications of one factorisation, those with stored zeros included.
    #[must_use]
    pub fn factor_multiplications(&self) -> f64 {
        self.symbolic.multiplications
    }

    /// The equation at a position of the elimination order.
    pub(crate) fn row_at(&self, position: usize) -> Row {
        let variable = self.symbolic.order[position] as usize;
        if variable < self.n { Row::Unknown(variable) } else { Row::Multiplier(variable - self.n) }
    }
}

fn check_size(what: &'static str, count: usize) -> Result<(), SparseError> {
    if count < (i32::MAX / 2) as usize { Ok(()) } else { Err(SparseError::TooLarge { what, count }) }
}

/// Entries inside the system, checked against the block's size.
fn checked<'a>(
    entries: &'a [Option<(usize, usize)>],
    list: EntryList,
    rows: usize,
    columns: usize,
) -> impl Iterator<Item = Result<(u32, u32), SparseError>> + 'a {
    entries.iter().enumerate().filter_map(move |(entry, &place)| {
        let (row, column) = place?;
        Some(if row < rows && column < columns {
            Ok((row as u32, column as u32))
        } else {
            Err(SparseError::EntryOutside { list, entry, row, column, rows, columns })
        })
    })
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (at, &variable) in order.iter().enumerate() {
        position[variable as usize] = at as u32;
    }
    position
}

/// Pattern of `K` with row and column of each variable at its position.
fn saddle_rows(leading: &Rows, jacobian: &Rows, position: &[u32]) -> Rows {
    let n = leading.len();
    let mut pairs = Vec::with_capacity(leading.column().len() + 2 * jacobian.column().len());
    for i in 0..n {
        pairs.extend(leading.row(i).iter().map(|&c| (position[i], position[c as usize])));
    }
    for j in 0..jacobian.len() {
        let row = position[n + j];
        for &c in jacobian.row(j) {
            let column = position[c as usize];
            pairs.extend([(row, column), (column, row)]);
        }
    }
    Rows::from_pairs(position.len(), position.len(), &pairs)
}

/// [`SaddlePattern::assembly`] and where the list of each front starts in it.
type Assembly = (Vec<(u32, u32)>, Vec<usize>);

/// For each front, which slots of the compressed rows go where in its panel.
fn assemble_fronts(symbolic: &Symbolic, rows: &Rows) -> Result<Assembly, SparseError> {
    let mut assembly = Vec::with_capacity(rows.column().len());
    let mut start = vec![0];
    let mut place = vec![0_usize; rows.len()];
    for front in &symbolic.fronts {
        let (end, stride) = (front.first + front.width, front.stride());
        check_size("entries in one front", front.width.saturating_mul(stride))?;
        for (at, &i) in symbolic.rest[front.rest.clone()].iter().enumerate() {
            place[i as usize] = front.width + at;
        }
        for i in front.first..end {
            let from = rows.row(i).partition_point(|&c| (c as usize) < front.first);
            for (at, &c) in rows.row(i).iter().enumerate().skip(from) {
                let row = (i - front.first) * stride;
                let slot = (rows.start()[i] + at) as u32;
                let column = c as usize;
                if column < end {
                    assembly.push((slot, (row + column - front.first) as u32));
                } else {
                    assembly.push((slot, (row + place[column]) as u32));
                    // The entry across the diagonal belongs to the column part of the same panel row.
                    let transposed =
                        rows.start()[column] + rows.row(column).partition_point(|&k| (k as usize) < i);
                    assembly.push((transposed as u32, (row + place[column] + front.rest_len()) as u32));
                }
            }
        }
        start.push(assembly.len());
    }
    Ok((assembly, start))
}

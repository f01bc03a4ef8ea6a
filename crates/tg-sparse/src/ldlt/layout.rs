//! Where fronts, vectors and entries of the matrix are kept.

use super::batch::{self, Batch};
use super::batching::Batching;
use super::single::Single;
use crate::kernels::LANES;
use crate::pattern::SaddlePattern;
use crate::symbolic::Symbolic;

/// No position: an idle lane.
pub(super) const NONE: u32 = u32::MAX;

/// Places of all fronts and vectors.
#[derive(Clone, Debug)]
pub(crate) struct LdltLayout {
    pub(super) batches: Vec<Batch>,
    /// Where the batches leave what they add to others.
    pub(super) targets: Vec<u32>,
    pub(super) singles: Vec<Single>,
    homes: Vec<Home>,
    /// Places of the later positions of each front, as in [`Symbolic::rest`].
    pub(super) later: Vec<u32>,
    /// Position → place in vectors.
    place: Vec<u32>,
    /// Place → position.
    pub(super) position: Vec<u32>,
    panel_len: usize,
    pub(super) update_len: usize,
    pub(super) local_len: usize,
}

/// Which batch and lane a front is in, or which single front it is.
#[derive(Clone, Copy, Debug)]
enum Home {
    Batch(usize, usize),
    Single(usize),
}

impl LdltLayout {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let mut layout = Self {
            batches: Vec::new(),
            targets: Vec::new(),
            singles: Vec::new(),
            homes: Vec::with_capacity(symbolic.fronts.len()),
            later: Vec::new(),
            place: vec![0; symbolic.order.len()],
            position: Vec::new(),
            panel_len: 0,
            update_len: 0,
            local_len: 0,
        };
        let batching = Batching::new(symbolic);
        for lanes in &batching.batches {
            layout.place_batch(symbolic, lanes);
        }
        for (at, &home) in batching.homes.iter().enumerate() {
            let home = match home {
                Some((batch, lane)) => Home::Batch(batch, lane),
                None => layout.place_single(symbolic, at),
            };
            layout.homes.push(home);
        }
        layout.position.resize(layout.position.len().next_multiple_of(LANES), NONE);
        layout.later = symbolic.rest.iter().map(|&i| layout.place[i as usize]).collect();
        for (at, lanes) in batching.batches.iter().enumerate() {
            layout.find_targets(symbolic, at, lanes);
        }
        layout
    }

    /// A vector's length, with one chunk more for what idle lanes leave.
    pub(crate) fn vector_len(&self) -> usize {
        self.position.len() + LANES
    }

    /// The panels' length, with one chunk more for what has no place.
    pub(crate) fn panels_len(&self) -> usize {
        self.panel_len + LANES
    }

    /// The place in the panels of what has none.
    pub(crate) fn outside(&self) -> u32 {
        self.panel_len as u32
    }

    /// Places in vectors of all variables.
    pub(crate) fn variables(&self, symbolic: &Symbolic) -> Vec<u32> {
        let mut variables = vec![0; symbolic.order.len()];
        for (&place, &variable) in self.place.iter().zip(&symbolic.order) {
            variables[variable as usize] = place;
        }
        variables
    }

    /// Place in the panels of each slot of the compressed rows; those below the diagonal have none, like the
    /// entries outside of the system: [`LdltLayout::outside`].
    pub(crate) fn slots(&self, pattern: &SaddlePattern) -> Vec<u32> {
        let (rows, symbolic) = (&pattern.slots.rows, &pattern.symbolic);
        let mut slots = vec![self.outside(); rows.column().len() + 1];
        for (at, front) in symbolic.fronts.iter().enumerate() {
            for position in front.first..front.first + front.width {
                for slot in rows.start()[position]..rows.start()[position + 1] {
                    let column = rows.column()[slot] as usize;
                    if column >= position {
                        slots[slot] = self.entry(symbolic, at, position, column) as u32;
                    }
                }
            }
        }
        slots
    }

    /// Places in the panels of the diagonal, by places in vectors; idle lanes too.
    pub(crate) fn diagonal(&self) -> Vec<u32> {
        let mut diagonal = Vec::with_capacity(self.position.len());
        for batch in &self.batches {
            for row in 0..batch.width {
                let chunk = batch.panel + batch::entry(row, row, batch.width + batch.rest);
                diagonal.extend((0..LANES).map(|lane| (chunk * LANES + lane) as u32));
            }
        }
        for single in &self.singles {
            diagonal.extend((0..single.width).map(|row| single.entry(row, row) as u32));
        }
        diagonal
    }

    /// Whether no position is at a place: an idle lane.
    pub(crate) fn is_idle(&self, place: usize) -> bool {
        self.position[place] == NONE
    }

    fn place_batch(&mut self, symbolic: &Symbolic, lanes: &[Option<usize>; LANES]) {
        let Some(&like) = lanes.iter().flatten().next() else { return };
        let (width, rest) = (symbolic.fronts[like].width, symbolic.fronts[like].rest_len());
        let (panel, first) = (self.panel_len / LANES, self.position.len() / LANES);
        for row in 0..width {
            for front in lanes {
                let position = front.map_or(NONE, |front| (symbolic.fronts[front].first + row) as u32);
                if position != NONE {
                    self.place[position as usize] = self.position.len() as u32;
                }
                self.position.push(position);
            }
        }
        self.panel_len += batch::panel_len(width, rest) * LANES;
        self.local_len = self.local_len.max(width * (width + rest) * LANES);
        self.batches.push(Batch { width, rest, panel, first, targets: 0, together: true, reach: 0 });
    }

    fn place_single(&mut self, symbolic: &Symbolic, at: usize) -> Home {
        let front = &symbolic.fronts[at];
        let children = symbolic.children[front.children.clone()].iter();
        let children = children.filter_map(|&child| match self.homes[child as usize] {
            Home::Single(child) => Some(child as u32),
            Home::Batch(..) => None,
        });
        let single = Single {
            first: self.position.len(),
            width: front.width,
            rest: front.rest.clone(),
            panel: self.panel_len,
            update: self.update_len,
            children: children.collect(),
        };
        for position in front.first..front.first + front.width {
            self.place[position] = self.position.len() as u32;
            self.position.push(position as u32);
        }
        self.panel_len += single.panel_len();
        self.update_len += single.update_len();
        self.local_len = self.local_len.max(single.rest_stride());
        self.singles.push(single);
        Home::Single(self.singles.len() - 1)
    }

    /// Place in the panels of an entry on or right of the diagonal, its row in front `at`.
    fn entry(&self, symbolic: &Symbolic, at: usize, row: usize, column: usize) -> usize {
        let front = &symbolic.fronts[at];
        let own = column - front.first;
        let column = if own < front.width {
            own
        } else {
            front.width + symbolic.rest[front.rest.clone()].partition_point(|&i| (i as usize) < column)
        };
        match self.homes[at] {
            Home::Batch(at, lane) => {
                let batch = &self.batches[at];
                let order = batch.width + batch.rest;
                (batch.panel + batch::entry(row - front.first, column, order)) * LANES + lane
            }
            Home::Single(at) => self.singles[at].entry(row - front.first, column),
        }
    }

    /// Where a batch leaves what it adds to others.
    fn find_targets(&mut self, symbolic: &Symbolic, at: usize, lanes: &[Option<usize>; LANES]) {
        let rest = self.batches[at].rest;
        let count = batch::targets_len(rest, true);
        // By target and lane; idle lanes add zeros where nothing is.
        let nowhere = |target| if target < rest { self.position.len() } else { self.panel_len } as u32;
        let mut targets: Vec<[u32; LANES]> = (0..count).map(|target| [nowhere(target); LANES]).collect();
        for (lane, front) in lanes.iter().enumerate() {
            let &Some(front) = front else { continue };
            let later = &symbolic.rest[symbolic.fronts[front].rest.clone()];
            let rows = later.iter().map(|&i| self.place[i as usize] as usize);
            let entries = later.iter().enumerate().flat_map(|(i, &row)| {
                let owner = symbolic.front_of(row as usize);
                later[i..].iter().map(move |&column| (owner, row as usize, column as usize))
            });
            let entries = entries.map(|(owner, row, column)| self.entry(symbolic, owner, row, column));
            for (target, place) in targets.iter_mut().zip(rows.chain(entries)) {
                target[lane] = place as u32;
            }
        }
        let batch = &self.batches[at];
        let own = batch.panel + batch::panel_len(batch.width, rest);
        let far = targets[rest..].iter().flatten().filter(|&&place| (place as usize) < self.panel_len);
        let far = far.max().map_or(0, |&place| place as usize / LANES + 1);
        let before = at.checked_sub(1).map_or(0, |before| self.batches[before].reach);
        let reach = before.max(own).max(far);
        let chunk = |target: &[u32; LANES]| {
            let mut chunks = (0..LANES).filter(|&lane| lanes[lane].is_some()).map(|lane| {
                let place = target[lane] as usize;
                (place % LANES == lane).then_some((place / LANES) as u32)
            });
            let first = chunks.next().flatten()?;
            chunks.all(|chunk| chunk == Some(first)).then_some(first)
        };
        let together: Option<Vec<u32>> = targets.iter().map(chunk).collect();
        let batch = &mut self.batches[at];
        batch.targets = self.targets.len();
        batch.together = together.is_some();
        batch.reach = reach;
        self.targets.extend(together.unwrap_or_else(|| targets.into_flattened()));
    }
}

//! Which fronts are eliminated side by side: those of one shape and one height above the leaves, [`LANES`] at a time.
//!
//! Fronts of one height do not wait for each other. Where the parents of a batch have one shape too (bars in parallel chains,
//! bodies with equal neighbourhoods) each stays in the lane of its child, so that updates move whole chunks.

use std::collections::BTreeMap;

use crate::kernels::LANES;
use crate::symbolic::Symbolic;

/// Order of a front (own and later positions) that is worth a batch for each of its lanes in use. A larger one works
/// faster alone, with its rows in chunks.
const ORDER_PER_LANE: usize = 8;

/// Lanes of a batch whose parents form the next batch as they are.
const LANES_KEPT: usize = 3;

/// Fronts in lanes.
pub(super) struct Batching {
    /// Batch and lane of each front that is in one.
    pub(super) homes: Vec<Option<(usize, usize)>>,
    /// The fronts of each batch, by lane; children come before their parents.
    pub(super) batches: Vec<[Option<usize>; LANES]>,
}

impl Batching {
    pub(super) fn new(symbolic: &Symbolic) -> Self {
        let mut batching = Self { homes: vec![None; symbolic.fronts.len()], batches: Vec::new() };
        for ((_, width, rest), mut fronts) in same_shape_and_height(symbolic) {
            fronts.retain(|&front| batching.children_are_home(symbolic, front));
            for lanes in batching.share_lanes(symbolic, &fronts) {
                let used = lanes.iter().flatten().count();
                if width + rest <= ORDER_PER_LANE * used {
                    batching.add(lanes);
                }
            }
        }
        batching
    }

    /// Only fronts without batch take update matrices from children without batch.
    fn children_are_home(&self, symbolic: &Symbolic, front: usize) -> bool {
        let children = &symbolic.children[symbolic.fronts[front].children.clone()];
        children.iter().all(|&child| self.homes[child as usize].is_some())
    }

    fn share_lanes(&self, symbolic: &Symbolic, fronts: &[usize]) -> Vec<[Option<usize>; LANES]> {
        let first_child = |front: usize| {
            let children = symbolic.fronts[front].children.clone();
            symbolic.children[children].first().and_then(|&child| self.homes[child as usize])
        };
        let mut by_child: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
        for &front in fronts {
            by_child.entry(first_child(front).map(|(batch, _)| batch)).or_default().push(front);
        }
        let (mut batches, mut others) = (Vec::new(), Vec::new());
        for (child, fronts) in by_child {
            if child.is_none() || fronts.len() < LANES_KEPT {
                others.extend(fronts);
                continue;
            }
            let mut lanes = [None; LANES];
            for front in fronts {
                let (_, lane) = first_child(front).unwrap_or_default();
                lanes[lane] = Some(front);
            }
            batches.push(lanes);
        }
        for fronts in others.chunks(LANES) {
            let mut lanes = [None; LANES];
            lanes.iter_mut().zip(fronts).for_each(|(lane, &front)| *lane = Some(front));
            batches.push(lanes);
        }
        batches
    }

    fn add(&mut self, lanes: [Option<usize>; LANES]) {
        for (lane, front) in lanes.iter().enumerate() {
            if let &Some(front) = front {
                self.homes[front] = Some((self.batches.len(), lane));
            }
        }
        self.batches.push(lanes);
    }
}

/// Fronts by height above the leaves, width and number of later positions.
fn same_shape_and_height(symbolic: &Symbolic) -> BTreeMap<(u32, usize, usize), Vec<usize>> {
    let mut height = vec![0_u32; symbolic.fronts.len()];
    let mut groups: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (at, front) in symbolic.fronts.iter().enumerate() {
        let children = symbolic.children[front.children.clone()].iter();
        height[at] = children.map(|&child| height[child as usize] + 1).max().unwrap_or(0);
        groups.entry((height[at], front.width, front.rest_len())).or_default().push(at);
    }
    groups
}

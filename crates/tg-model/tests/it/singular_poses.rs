//! The linear system of mass and constraints near a pose in which the constraints lose their rank.

use tg_model::{InertialSystem, Joining, Mechanics, MemberId, Model, ModelBuilder};

use crate::support::Random;

/// Crank and rocker of length `size`, coupler and ground of twice that: a parallelogram that can fold into a line.
struct FourBar {
    model: Model<2>,
    bars: [MemberId; 3],
    size: f64,
}

impl FourBar {
    fn new(size: f64) -> Self {
        let mut b = ModelBuilder::<2>::new();
        let knee = [0.6 * size, 0.8 * size];
        let far = [2.0 * size + knee[0], knee[1]];
        let left = b.anchor("left", [0.0, 0.0]).unwrap();
        let right = b.anchor("right", [2.0 * size, 0.0]).unwrap();
        let crank = b.bar("crank", 1.0, [0.0, 0.0], knee).unwrap();
        let coupler = b.bar("coupler", 2.0, knee, far).unwrap();
        let rocker = b.bar("rocker", 3.0, [2.0 * size, 0.0], far).unwrap();
        b.joint("left hinge", &[left.into(), crank.node(0)], Joining::Share).unwrap();
        b.joint("right hinge", &[right.into(), rocker.node(0)], Joining::Share).unwrap();
        b.joint("left knee", &[crank.node(1), coupler.node(0)], Joining::Share).unwrap();
        b.joint("right knee", &[rocker.node(1), coupler.node(1)], Joining::Share).unwrap();
        Self { model: b.build().unwrap(), bars: [crank, coupler, rocker], size }
    }

    /// Coordinates with the crank at an angle from the line.
    fn at(&self, angle: f64) -> Vec<f64> {
        let mut q = self.model.initial_coordinates();
        let (sin, cos) = angle.sin_cos();
        for (bar, foot) in [(self.bars[0], 0.0), (self.bars[2], 2.0)] {
            let knee = 2 * self.model.member_node_ids(bar)[1];
            q[knee..knee + 2].copy_from_slice(&[(foot + cos) * self.size, sin * self.size]);
        }
        q
    }

    /// Largest |M x - Aᵀ y - f| and |A x - g| per largest term, for random f and g.
    fn residual(&self, system: &mut InertialSystem<'_>, random: &mut Random) -> f64 {
        let (n, size) = (system.layout().unknowns(), system.size());
        let mut rhs = random.vector(size, 1.0);
        // As sizes have it: forces, and constraints in square metres.
        rhs[n..].iter_mut().for_each(|g| *g *= self.size);
        let given = rhs.clone();
        system.solve(&mut rhs).unwrap();
        let (mut left, mut terms) = (given.clone(), given.iter().map(|x| x.abs()).collect::<Vec<_>>());
        let unknown = |i: usize| system.layout().unknown(i);
        let mut take = |row: usize, term: f64| {
            left[row] -= term;
            terms[row] += term.abs();
        };
        for entry in self.model.mass() {
            if let (Some(i), Some(j)) = (unknown(entry.row), unknown(entry.col)) {
                take(i, entry.value * rhs[j]);
            }
        }
        for (&(constraint, coordinate), a) in self.model.jacobian_pattern().iter().zip(system.jacobian()) {
            if let Some(i) = unknown(coordinate) {
                take(i, -a * rhs[n + constraint]);
                take(n + constraint, a * rhs[i]);
            }
        }
        left.iter().zip(&terms).map(|(left, terms)| left.abs() / terms).fold(0.0, f64::max)
    }
}

#[test]
fn a_pose_in_which_constraints_lose_their_rank_is_refused_at_any_size() {
    for size in [1e-6, 1.0, 1e6] {
        let four_bar = FourBar::new(size);
        let mut system = InertialSystem::new(&four_bar.model).unwrap();
        for angle in [0.5, 1e-2, 1e-4, 1e-5] {
            assert!(system.factor(&four_bar.at(angle)).is_ok(), "{size:e}, {angle:e}");
        }
        for angle in [3e-9, 1e-10, 1e-14, 0.0] {
            assert!(system.factor(&four_bar.at(angle)).is_err(), "{size:e}, {angle:e}");
        }
    }
}

#[test]
fn what_is_solved_belongs_to_the_last_pose() {
    let four_bar = FourBar::new(1.0);
    let mut system = InertialSystem::new(&four_bar.model).unwrap();
    let random = &mut Random::new(7);
    // From plain factors to checked ones and back.
    for angle in [0.9, 1e-5, 0.4, 2e-6, 1.2] {
        system.factor(&four_bar.at(angle)).unwrap();
        let left = four_bar.residual(&mut system, random);
        assert!(left < 1e-9, "{angle:e}: {left:e}");
    }
}

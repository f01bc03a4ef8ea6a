//! Whether two models are the same structure: coordinates of one are mapped to those of the other by names.

use tg_cases::simulate::run;
use tg_modal::{ModeOptions, modes};
use tg_model::{At, Mechanics, Model};
use tg_statics::{Forward, ForwardOptions};
use tg_tangent::Configuration;

/// Relative difference that is rounding.
pub(super) const EXACT: f64 = 1e-12;

/// A scene's model beside that of the code.
pub(super) struct Pair<'m, const D: usize> {
    scene: &'m Model<D>,
    code: &'m Model<D>,
    /// For each node of the scene's model the same node of the code's.
    nodes: Vec<usize>,
}

/// Numbers in [-1, 1], the same on every machine.
fn random(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x2545_f491_4f6c_dd1d) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// Asserts that two lists differ by rounding, relative to their largest number.
#[track_caller]
fn assert_close(what: &str, scene: &[f64], code: &[f64]) {
    assert_eq!(scene.len(), code.len(), "{what}");
    let size = code.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    for (k, (a, b)) in scene.iter().zip(code).enumerate() {
        assert!((a - b).abs() <= EXACT * size, "{what}, number {k}: {a} in the scene, {b} in the code");
    }
}

impl<'m, const D: usize> Pair<'m, D> {
    /// Checks members by their names, and maps nodes.
    pub(super) fn new(scene: &'m Model<D>, code: &'m Model<D>) -> Self {
        let mut nodes = vec![None; scene.initial_coordinates().len() / D];
        assert_eq!(scene.members().len(), code.members().len());
        for (ours, theirs) in scene.members().zip(code.members()) {
            // The same order too.
            assert_eq!(scene.member_name(ours), code.member_name(theirs));
            let (a, b) = (scene.member(ours), code.member(theirs));
            let name = scene.member_name(ours);
            assert_eq!(a.coord_type(), b.coord_type(), "{name}");
            let (mass_a, mass_b) = (a.mass_properties(), b.mass_properties());
            assert_close(&format!("{name}: mass"), &[mass_a.mass()], &[mass_b.mass()]);
            assert_close(&format!("{name}: centre"), mass_a.centre().as_slice(), mass_b.centre().as_slice());
            let (moment_a, moment_b) = (mass_a.second_moment(), mass_b.second_moment());
            assert_close(&format!("{name}: second moment"), moment_a.as_slice(), moment_b.as_slice());
            let (ours, theirs) = (scene.member_node_ids(ours), code.member_node_ids(theirs));
            assert_eq!(ours.len(), theirs.len(), "{name}");
            for (&a, &b) in ours.iter().zip(theirs) {
                // What is shared in one is shared in the other.
                assert!(nodes[a].is_none_or(|known| known == b), "{name}: another node is shared");
                nodes[a] = Some(b);
            }
        }
        let others = code.initial_coordinates().len() / D;
        let by_name = |a: usize| (0..others).find(|&b| code.node_name(b) == scene.node_name(a));
        let nodes: Vec<_> =
            nodes.iter().enumerate().map(|(a, b)| b.or_else(|| by_name(a)).unwrap()).collect();
        let mut sorted = nodes.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..others).collect::<Vec<_>>(), "each node once");
        Self { scene, code, nodes }
    }

    /// A vector over the code's coordinates in the scene's.
    fn mapped(&self, x: &[f64]) -> Vec<f64> {
        self.nodes.iter().flat_map(|&n| x[n * D..n * D + D].iter().copied()).collect()
    }

    /// The code's inputs in the scene's order.
    fn mapped_inputs(&self, u: &[f64]) -> Vec<f64> {
        let names: Vec<_> = (0..u.len()).map(|k| self.code.input_name(k)).collect();
        let ours = (0..self.scene.inputs_at(0.0).len()).map(|k| self.scene.input_name(k));
        ours.map(|name| u[names.iter().position(|other| *other == name).unwrap()]).collect()
    }

    /// For each constraint of the scene the code's of the same name.
    fn constraints(&self) -> Vec<usize> {
        let count = self.code.sizes().constraints;
        assert_eq!(self.scene.sizes().constraints, count);
        let names: Vec<_> = (0..count).map(|k| self.code.constraint_name(k)).collect();
        let find = |k: usize| {
            let name = self.scene.constraint_name(k);
            names.iter().position(|other| *other == name).unwrap_or_else(|| panic!("{name}: {names:?}"))
        };
        let found: Vec<_> = (0..count).map(find).collect();
        let mut sorted = found.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..count).collect::<Vec<_>>(), "each constraint once");
        found
    }

    /// Everything that a solver sees, as built and at random configurations.
    #[track_caller]
    pub(super) fn assert_same_mechanics(&self) {
        let (scene, code) = (self.scene, self.code);
        let (a, b) = (scene.report(), code.report());
        assert_eq!((a.free, a.intrinsic, a.extrinsic), (b.free, b.intrinsic, b.extrinsic));
        assert_eq!(a.degrees_of_freedom(), b.degrees_of_freedom());
        let built = code.initial_coordinates();
        let n = built.len();
        let marks = |model: &Model<D>| {
            let mut marks = vec![0.0; n];
            model.free().iter().for_each(|&i| marks[i] = 1.0);
            marks
        };
        assert_eq!(marks(scene), self.mapped(&marks(code)), "free coordinates");
        assert_close("initial nodes", &scene.initial_coordinates(), &self.mapped(&built));
        assert_close(
            "initial velocities",
            &scene.velocities_at_rest(),
            &self.mapped(&code.velocities_at_rest()),
        );
        assert_eq!(scene.gravity(), code.gravity());
        for t in [0.0, 0.013, 0.2, 1.7, 6.0, 11.0] {
            assert_close("inputs", &scene.inputs_at(t), &self.mapped_inputs(&code.inputs_at(t)));
        }
        self.assert_same_cables();
        let size = built.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        for seed in 1..=5 {
            let shake = random(seed, n);
            let mut q: Vec<f64> = built.iter().zip(&shake).map(|(q, s)| q + 0.2 * size * s).collect();
            let mut v = random(seed + 100, n);
            let t = 0.37 * seed as f64;
            let (mut p, mut w) = (self.mapped(&q), self.mapped(&v));
            code.prescribe(t, &mut q, &mut v);
            scene.prescribe(t, &mut p, &mut w);
            assert_close("prescribed positions", &p, &self.mapped(&q));
            assert_close("prescribed velocities", &w, &self.mapped(&v));
            self.assert_same_at(&q, &v, t);
        }
    }

    fn assert_same_cables(&self) {
        let (scene, code) = (self.scene, self.code);
        assert_eq!(scene.cables().len(), code.cables().len());
        for (ours, theirs) in scene.cables().zip(code.cables()) {
            let name = scene.cable_name(ours);
            assert_eq!(name, code.cable_name(theirs));
            // Debug shows which law it is with all of its numbers.
            let (a, b) = (scene.cable_law(ours), code.cable_law(theirs));
            assert_eq!(format!("{a:?}"), format!("{b:?}"), "{name}");
        }
    }

    /// Ends, tensions, forces, mass, constraints and their gradients, energy.
    fn assert_same_at(&self, q: &[f64], v: &[f64], t: f64) {
        let (scene, code) = (self.scene, self.code);
        let (p, w, u) = (self.mapped(q), self.mapped(v), code.inputs_at(t));
        let ours = scene.inputs_at(t);
        let (mut tensions, mut others) = (Vec::new(), Vec::new());
        for (a, b) in scene.cables().zip(code.cables()) {
            let (l, other) = (scene.cable_form(a).eval(&p), code.cable_form(b).eval(q));
            assert_close(
                &format!("{}: from end to end", scene.cable_name(a)),
                l.as_slice(),
                other.as_slice(),
            );
            tensions.push(scene.cable(a, &p, &w, &ours).tension);
            others.push(code.cable(b, q, v, &u).tension);
        }
        assert_close("tensions", &tensions, &others);
        let force = |model: &Model<D>, q: &[f64], v: &[f64], u: &[f64]| {
            let mut f = vec![0.0; q.len()];
            model.force(At { q, v, u, taut: None }, &mut f);
            f
        };
        assert_close("force", &force(scene, &p, &w, &ours), &self.mapped(&force(code, q, v, &u)));
        let momentum = |model: &Model<D>, v: &[f64]| {
            let mut momentum = vec![0.0; v.len()];
            model.mass().iter().for_each(|m| momentum[m.row] += m.value * v[m.col]);
            momentum
        };
        assert_close("momentum", &momentum(scene, &w), &self.mapped(&momentum(code, v)));
        assert_close("potential", &[scene.potential(&p, &ours)], &[code.potential(q, &u)]);
        let constraints = self.constraints();
        let phi = |model: &Model<D>, q: &[f64]| {
            let mut phi = vec![0.0; constraints.len()];
            model.constraints(q, &mut phi);
            phi
        };
        let rates = |model: &Model<D>, q: &[f64], v: &[f64]| {
            let mut values = vec![0.0; model.jacobian_pattern().len()];
            model.jacobian(q, &mut values);
            let mut rates = vec![0.0; constraints.len()];
            for (&(row, i), a) in model.jacobian_pattern().iter().zip(&values) {
                rates[row] += a * v[i];
            }
            rates
        };
        let reordered = |x: Vec<f64>| constraints.iter().map(|&k| x[k]).collect::<Vec<_>>();
        assert_close("constraints", &phi(scene, &p), &reordered(phi(code, q)));
        assert_close("rates of constraints", &rates(scene, &p, &w), &reordered(rates(code, q, v)));
    }

    /// The last state of a short run from rest.
    #[track_caller]
    pub(super) fn assert_same_run(&self, h: f64, end: f64) {
        let last = |model: &Model<D>| {
            let mut last = None;
            run(model, h, end, |state| last = Some((state.q.clone(), state.v.clone()))).unwrap();
            last.unwrap()
        };
        let ((q, v), (code_q, code_v)) = (last(self.scene), last(self.code));
        assert_close("coordinates at the end", &q, &self.mapped(&code_q));
        assert_close("velocities at the end", &v, &self.mapped(&code_v));
        assert_ne!(q, self.scene.initial_coordinates(), "nothing moved");
    }

    /// All frequencies about the configuration as built, and tensions there; how many.
    #[track_caller]
    pub(super) fn assert_same_frequencies(&self) -> usize {
        let frequencies = |model: &Model<D>| -> Vec<f64> {
            let at = Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
            modes(model, &at, &ModeOptions::all()).unwrap().frequencies().collect()
        };
        let (scene, code) = (frequencies(self.scene), frequencies(self.code));
        assert_eq!(scene.len(), code.len());
        for (a, b) in scene.iter().zip(&code) {
            assert!((a - b).abs() <= EXACT * b, "{a} Hz in the scene, {b} Hz in the code");
        }
        code.len()
    }

    /// Lengths of all cables in the equilibrium under the loads, found from the configuration as built; where the structure
    /// stands on its plane is nobody's choice.
    #[track_caller]
    pub(super) fn assert_same_equilibrium(&self) {
        let lengths = |model: &Model<D>| -> Vec<f64> {
            let forward = Forward::new(model, ForwardOptions::default());
            let found = forward.solve(&model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
            model.cables().map(|cable| model.cable_form(cable).eval(&found.configuration.q).norm()).collect()
        };
        assert_close("lengths in equilibrium", &lengths(self.scene), &lengths(self.code));
    }
}

//! The guyed prism mast against positions that another program found.

use crate::support::{composition, distance, explicit, fixed, position, run, start};
use tg_fixtures::mast;
use tg_integrate::{CompositionScheme, EmbeddedPair, Stepper};

/// The three nodes of the top level of the mast of two stages at 0.5, 1, 1.5 and 2 s \[m\], to ten digits: central
/// differences at steps of 2e-5 s and finer in node coordinates, a program of its own.
const TWO_STAGES: [[[f64; 3]; 3]; 4] = [
    [
        [0.08014329559, -0.00624147321, 0.30492656951],
        [-0.03970734804, 0.06296773773, 0.3070561262],
        [-0.03983843446, -0.07560554467, 0.30245629612],
    ],
    [
        [0.080260829, -0.0057895988, 0.30488801804],
        [-0.0395677671, 0.06341634107, 0.30694158353],
        [-0.03973466332, -0.07517122453, 0.3026373676],
    ],
    [
        [0.08019520608, -0.00540818559, 0.30491990321],
        [-0.03963014561, 0.06378070228, 0.30681391317],
        [-0.03981245116, -0.07480936139, 0.30275390762],
    ],
    [
        [0.08019138034, -0.00554702689, 0.3049192481],
        [-0.03963706954, 0.06364693017, 0.30685500533],
        [-0.03981251597, -0.07494079787, 0.30270588333],
    ],
];
/// The same of the mast of eight stages at 0.5 s.
const EIGHT_STAGES: [[f64; 3]; 3] = [
    [0.09126726508, -0.00057475942, 1.21644417981],
    [-0.02848847785, 0.06846695496, 1.22161692185],
    [-0.02879875354, -0.07010793932, 1.21804204053],
];
/// Digits of the reference.
const KNOWN: f64 = 2e-10;

/// Largest distance of the top's nodes from the reference at the multiples of half a second.
fn errors(
    stages: usize,
    reference: &[[[f64; 3]; 3]],
    h: f64,
    stepper: impl Fn(&tg_model::Model<3>) -> Box<dyn Stepper + '_>,
) -> Vec<f64> {
    let mast = mast(stages).unwrap();
    let mut stepper = stepper(&mast.model);
    let mut state = start(&mast.model, stepper.as_mut());
    let at = |(k, top): (usize, &[[f64; 3]; 3])| {
        run(stepper.as_mut(), &mut state, h, 0.5 * (k + 1) as f64);
        let nodes = &mast.nodes[mast.nodes.len() - 3..];
        nodes
            .iter()
            .zip(top)
            .map(|(&node, p)| distance(&position(&mast.model, node, &state.q), p))
            .fold(0.0, f64::max)
    };
    reference.iter().enumerate().map(at).collect()
}

#[test]
fn explicit_schemes_find_the_reference() {
    let (five, eight) = (EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8);
    let exact = errors(2, &TWO_STAGES, 0.5, |m| Box::new(explicit(m, eight, 1e-9)));
    let default = errors(2, &TWO_STAGES, 0.5, |m| Box::new(explicit(m, five, 1e-6)));
    let tall = errors(8, &[EIGHT_STAGES], 0.5, |m| Box::new(explicit(m, eight, 1e-9)));
    let steps = errors(8, &[EIGHT_STAGES], 4e-3, |m| Box::new(fixed(m, five)));
    println!("{exact:?} {default:?} {tall:?} {steps:?}");
    assert!(exact.iter().chain(&tall).all(|error| *error < KNOWN), "{exact:?} {tall:?}");
    assert!(default.iter().chain(&steps).all(|error| *error < 2e-8), "{default:?} {steps:?}");
}

#[test]
fn compositions_find_the_reference() {
    let found = errors(2, &TWO_STAGES[..1], 4e-3, |m| Box::new(composition(m, CompositionScheme::KahanLi6)));
    println!("{found:?}");
    assert!(found.iter().all(|error| *error < 1e-8), "{found:?}");
}

use tg_cases::mechanism::{Mechanism, Parameters};
use tg_equilibria::{EquilibriaOptions, all_equilibria};
#[test]
fn seeds() {
    for seed in 0..40 {
        let p = Parameters::random(seed);
        let m = Mechanism::new(&p).unwrap();
        let t = std::time::Instant::now();
        let r = all_equilibria(&m.model, &m.model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap();
        println!(
            "{seed} {:?} finite {} cert {} rej {} und {} failed {} sing {} real {} idx {} {:?}",
            p.rest,
            r.finite,
            r.certified,
            r.rejected,
            r.undecided,
            r.failed,
            r.singular.len(),
            r.equilibria.len(),
            r.index_sum(),
            t.elapsed()
        );
    }
}

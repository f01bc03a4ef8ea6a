mod support;
use support::*;
use tg_sparse::SaddleSystem;
#[test]
fn quick() {
    for bodies in [1, 2, 5] {
        for closed in [false, true] {
            let p = chain(bodies, 3, closed, 5);
            let mut s: SaddleSystem = p.system();
            s.factor().unwrap();
            let b = Random::new(1).vector(p.n + p.m);
            let mut x = b.clone();
            s.solve(&mut x).unwrap();
            let (rank, y) = full_pivoting(p.dense(), b, 1e-12);
            println!(
                "{rank} {} err {:e} entries {} fac {} mult {}",
                p.n + p.m,
                largest(x.iter().zip(&y).map(|(a, b)| a - b)),
                s.pattern().entries(),
                s.pattern().factor_entries(),
                s.pattern().factor_multiplications()
            );
        }
    }
}

//! Double-doubles and discs against exact arithmetic.

use tg_homotopy::{Complex64, ComplexDd, Dd, Disc, Field, Random, Scalar};

/// x as an integer multiple of 2^-120, exact for the numbers used here.
fn fixed(x: Dd) -> i128 {
    let part = |v: f64| -> i128 {
        // Powers of two: exact.
        let scaled = v * 2.0_f64.powi(60);
        let whole = scaled.trunc();
        ((whole as i128) << 40) + ((scaled - whole) * 2.0_f64.powi(40)) as i128
    };
    part(x.hi()) + part(x.lo())
}

#[test]
fn sums_and_products_have_thirty_digits() {
    let mut random = Random::new(4);
    for _ in 0..1000 {
        let (a, b) = (random.uniform(), random.uniform());
        // 26-bit numbers: squares and their products are exact in integers.
        let (i, j) = ((a * 2.0_f64.powi(26)).trunc(), (b * 2.0_f64.powi(26)).trunc());
        let (p, q) = (i * 2.0_f64.powi(-26), j * 2.0_f64.powi(-26));
        let x = Dd::from(p) * Dd::from(q) + Dd::from(p * 2.0_f64.powi(-26));
        let exact = ((i as i128 * j as i128) << 48) + ((i as i128) << 48);
        assert_eq!(fixed(x), exact);
    }
}

#[test]
fn division_and_roots_invert_multiplication() {
    let mut random = Random::new(5);
    for _ in 0..1000 {
        let a = Dd::from(random.uniform() + 0.1) / Dd::from(3.0);
        let b = Dd::from(random.uniform() + 0.1) / Dd::from(7.0);
        assert!((a / b * b - a).hi().abs() <= 1e-31 * a.hi().abs());
        let root = a.sqrt();
        assert!((root * root - a).hi().abs() <= 1e-31 * a.hi().abs());
        let z = ComplexDd::new(a, b);
        assert!((z * z.recip() - ComplexDd::one()).size() <= 1e-31);
    }
}

#[test]
fn discs_hold_the_results_of_their_members() {
    let mut random = Random::new(6);
    for _ in 0..2000 {
        let disc = |random: &mut Random| Disc::new(random.normal().into(), 0.1 * random.uniform());
        let (a, b) = (disc(&mut random), disc(&mut random));
        let member = |random: &mut Random, d: Disc| {
            let offset = random.unit() * (d.radius * random.uniform());
            d.mid + ComplexDd::from(offset)
        };
        let (x, y) = (member(&mut random, a), member(&mut random, b));
        // Points are discs without radius: whether a product lies inside is then decided by discs too.
        for (set, point) in [(a * b, x * y), (a + b, x + y), (a - b, x - y)] {
            assert!(!set.is_disjoint(Disc::exact(point)));
            let distance = (set.mid - point).to_c64().norm();
            assert!(distance <= set.radius, "{distance} > {}", set.radius);
        }
    }
}

#[test]
fn discs_of_exact_numbers_stay_thin() {
    let third = Disc::exact(
        ComplexDd::from(Complex64::new(1.0, 0.0)) * ComplexDd::from(Complex64::new(3.0, 0.0)).recip(),
    );
    let square = third * third;
    assert!(square.radius > 0.0 && square.radius < 1e-30);
    assert!(Disc::new(third.mid, 1e-20).is_interior_to(Disc::new(third.mid, 1.1e-20)));
    assert!(!Disc::new(third.mid, 1e-20).is_interior_to(Disc::new(third.mid, 1e-20)));
    assert!(Disc::new(third.mid, 0.1).is_disjoint(Disc::new(square.mid, 0.1)));
    assert!(!Disc::new(third.mid, 0.12).is_disjoint(Disc::new(square.mid, 0.12)));
}

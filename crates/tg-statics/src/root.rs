//! A root of a function of one variable inside a bracket (Chandrupatla 1997): inverse quadratic interpolation where it is
//! safe, bisection elsewhere.

/// The root between two points with values of opposite signs, to the rounding of the points.
pub(crate) fn find_root<E>(
    (mut a, mut fa): (f64, f64),
    (mut b, mut fb): (f64, f64),
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    const MOST: u32 = 200;
    // c is the point before a; the root lies between a and b.
    let mut t = 0.5;
    for _ in 0..MOST {
        let x = a + t * (b - a);
        let fx = f(x)?;
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let (best, value) = if fa.abs() < fb.abs() { (a, fa) } else { (b, fb) };
        let tolerance = 2.0 * f64::EPSILON * best.abs() / (b - a).abs();
        if value == 0.0 || tolerance > 0.5 || a == b {
            return Ok(best);
        }
        let (xi, phi) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
        t = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        } else {
            0.5
        };
        t = t.clamp(tolerance, 1.0 - tolerance);
    }
    Ok(if fa.abs() < fb.abs() { a } else { b })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(a: f64, b: f64, f: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut calls = 0;
        let found = find_root((a, f(a)), (b, f(b)), |x| {
            calls += 1;
            Ok::<f64, ()>(f(x))
        });
        (found.unwrap_or(f64::NAN), calls)
    }

    #[test]
    fn smooth_roots_take_few_calls() {
        for (a, b, f, exact) in [
            (0.0, 2.0, (|x| x * x - 2.0) as fn(f64) -> f64, 2.0_f64.sqrt()),
            (3.0, -3.0, |x| x.powi(3) - 0.001, 0.1),
            (0.1, 5.0, |x| x.ln() - 0.5, 0.5_f64.exp()),
        ] {
            let (x, calls) = root(a, b, f);
            assert!((x - exact).abs() < 1e-14 && calls < 30, "{x} after {calls} calls");
        }
    }

    #[test]
    fn a_jump_is_found_by_bisection() {
        let (x, calls) = root(-1.0, 3.0, |x| if x > 1.0 / 3.0 { 1.0 } else { -1e9 });
        assert!((x - 1.0 / 3.0).abs() < 1e-15 && calls < 120, "{x} after {calls} calls");
    }
}

//! Adaptive integration of `ẏ = f(t, y)` from t = 0 with exact output times and located events.
//!
//! A [`Flow`] is smooth while its indicators g_i(t, y) keep their signs. When one changes sign inside a step, the step is
//! taken again up to the root (found on the interpolating polynomial, then corrected by Newton's iteration on steps really
//! taken, to rounding), the flow is told, and the integration restarts there. Output times inside a step are likewise
//! reached by a step of their own from the step's start, so that they have the accuracy of the end points.

use super::ReferenceError;
use super::gauss::{Gauss, STAGES, Step, Sum};

/// Bound for the last Legendre coefficient of a step; the end point is accurate to about its square.
const TAIL: f64 = 1e-10;
/// Indicators closer to zero than this have not yet changed sign: the noise of a state placed on the root.
const NOISE: f64 = 1e-14;
/// Points of a step at which signs are compared.
const SAMPLES: usize = 8;
const FIRST_STEP: f64 = 1e-3;
const SMALLEST_STEP: f64 = 1e-9;
const MAX_SWITCHES_AT_ONCE: usize = 200;

/// A piecewise smooth system of ordinary differential equations.
pub(super) trait Flow<const N: usize> {
    /// f(t, y).
    fn rate(&self, t: f64, y: &[f64; N]) -> [f64; N];

    /// Fills g(t, y); the number of entries never changes. No entry: a smooth system.
    fn indicators(&self, _t: f64, _y: &[f64; N], g: &mut Vec<f64>) {
        g.clear();
    }

    /// Indicator `which` changed sign at `t`; it is positive from now on if `positive`.
    fn switch(&mut self, _t: f64, _which: usize, _positive: bool) {}
}

/// Integrates `flow` from `y` at t = 0 through `times`. `positive` are the signs of the indicators just after the start.
pub(super) fn integrate<const N: usize>(
    flow: &mut impl Flow<N>,
    y: [f64; N],
    mut positive: Vec<bool>,
    times: &[f64],
) -> Result<Vec<[f64; N]>, ReferenceError> {
    check_times(times)?;
    let gauss = Gauss::new();
    let mut states = Vec::with_capacity(times.len());
    let (mut t, mut y, mut h) = (0.0_f64, Sum::new(y), FIRST_STEP);
    let mut switches_at_once = 0;
    while states.len() < times.len() {
        if times[states.len()] <= t {
            states.push(y.hi);
            continue;
        }
        if h < SMALLEST_STEP {
            return Err(ReferenceError::StepTooSmall { t });
        }
        // The step that is really taken, t + h rounded.
        h = (t + h) - t;
        let rate = |t: f64, y: &[f64; N]| flow.rate(t, y);
        let Some(step) = gauss.step(rate, t, &y, h, None) else {
            h *= 0.5;
            continue;
        };
        let factor = 0.9 * (TAIL / step.tail().max(1e-30)).powf(1.0 / STAGES as f64);
        if factor < 0.7 {
            h *= factor.max(0.2);
            continue;
        }
        let next = h * factor.min(1.5);
        let partial =
            |tau: f64| gauss.step(rate, t, &y, tau, Some(&step)).ok_or(ReferenceError::StepTooSmall { t });

        let event = first_event(flow, t, h, &step, &positive);
        let (length, end) = match event {
            None => (h, step.end),
            Some((_, c)) if c * h < 1e-15 => (0.0, y),
            Some((which, c)) => locate(flow, t, h, &step, which, c, partial)?,
        };
        while states.len() < times.len() && times[states.len()] <= t + length {
            let tau = times[states.len()] - t;
            states.push(if tau == length { end.hi } else { partial(tau)?.end.hi });
        }
        (t, y, h) = (t + length, end, next);
        if let Some((which, _)) = event {
            positive[which] = !positive[which];
            flow.switch(t, which, positive[which]);
        }
        switches_at_once = if length > 0.0 { 0 } else { switches_at_once + 1 };
        if switches_at_once > MAX_SWITCHES_AT_ONCE {
            return Err(ReferenceError::Chatter { t });
        }
    }
    Ok(states)
}

fn check_times(times: &[f64]) -> Result<(), ReferenceError> {
    let mut last = 0.0;
    for (index, &value) in times.iter().enumerate() {
        if !value.is_finite() || value < last {
            return Err(ReferenceError::Times { index, value });
        }
        last = value;
    }
    Ok(())
}

/// Indicator that first changes sign inside the step and the fraction of the step where the polynomial says so.
fn first_event<const N: usize>(
    flow: &impl Flow<N>,
    t: f64,
    h: f64,
    step: &Step<N>,
    positive: &[bool],
) -> Option<(usize, f64)> {
    if positive.is_empty() {
        return None;
    }
    // Values are taken with the sign they have at the start: an event is a negative one.
    let values = |c: f64| {
        let mut g = Vec::with_capacity(positive.len());
        let y = if c == 1.0 { step.end.hi } else { step.state(c) };
        flow.indicators(t + c * h, &y, &mut g);
        g.iter_mut().zip(positive).for_each(|(v, p)| *v = if *p { *v } else { -*v });
        g
    };
    let slopes = |c: f64, g: &[f64]| {
        let d = 1e-6;
        values(c + d).iter().zip(g).map(|(v, g)| (v - g) / d).collect::<Vec<f64>>()
    };
    let (mut c0, mut g0) = (0.0, values(0.0));
    let mut s0 = slopes(c0, &g0);
    for k in 1..=SAMPLES {
        let c1 = k as f64 / SAMPLES as f64;
        let g1 = values(c1);
        let s1 = slopes(c1, &g1);
        let mut first: Option<(usize, f64)> = None;
        for i in 0..positive.len() {
            let mut hi = (g1[i] < -NOISE).then_some(c1);
            if hi.is_none() && s0[i] < 0.0 && s1[i] > 0.0 {
                // A dip between the samples: the tangents' intersection lies below it.
                let c = (g1[i] - g0[i] - s1[i] * c1 + s0[i] * c0) / (s0[i] - s1[i]);
                if g0[i] + s0[i] * (c - c0) < 0.0 {
                    let bottom = lowest(|c| values(c)[i], c0, c1);
                    hi = (values(bottom)[i] < -NOISE).then_some(bottom);
                }
            }
            if let Some(hi) = hi {
                let root = bisect(|c| values(c)[i], c0, hi);
                if first.is_none_or(|(_, c)| root < c) {
                    first = Some((i, root));
                }
            }
        }
        if first.is_some() {
            return first;
        }
        (c0, g0, s0) = (c1, g1, s1);
    }
    None
}

/// First point of \[lo, hi\] where `v` is negative; v(hi) < 0.
fn bisect(v: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    if v(lo) < 0.0 {
        return lo;
    }
    for _ in 0..50 {
        let mid = 0.5 * (lo + hi);
        if v(mid) < 0.0 { hi = mid } else { lo = mid }
    }
    hi
}

/// Minimum of `v` between `lo` and `hi` by ternary search.
fn lowest(v: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    for _ in 0..60 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if v(a) < v(b) { hi = b } else { lo = a }
    }
    0.5 * (lo + hi)
}

/// Corrects the root `c` of indicator `which` on steps really taken: length and end state.
fn locate<const N: usize>(
    flow: &impl Flow<N>,
    t: f64,
    h: f64,
    step: &Step<N>,
    which: usize,
    c: f64,
    partial: impl Fn(f64) -> Result<Step<N>, ReferenceError>,
) -> Result<(f64, Sum<N>), ReferenceError> {
    let mut g = Vec::new();
    let mut value = |t: f64, y: &[f64; N]| {
        flow.indicators(t, y, &mut g);
        g[which]
    };
    let d = 1e-5;
    let slope = (value(t + (c + d) * h, &step.state(c + d)) - value(t + (c - d) * h, &step.state(c - d)))
        / (2.0 * d * h);
    let mut length = c * h;
    for _ in 0..2 {
        let correction = value(t + length, &partial(length)?.end.hi) / slope;
        // At a grazing contact the slope vanishes and the polynomial's root is the best there is.
        if correction.abs() < 1e-3 * h && length > correction {
            length -= correction;
        }
    }
    length = (t + length) - t;
    Ok((length, partial(length)?.end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Unit mass on a one-sided spring: half periods π/w and π alternate, speed 1 at the switch.
    struct Bilinear {
        stiff: bool,
        switches: Vec<f64>,
    }
    const W: f64 = 7.0;

    impl Flow<2> for Bilinear {
        fn rate(&self, _t: f64, y: &[f64; 2]) -> [f64; 2] {
            [y[1], if self.stiff { -W * W * y[0] } else { -y[0] }]
        }
        fn indicators(&self, _t: f64, y: &[f64; 2], g: &mut Vec<f64>) {
            *g = vec![y[0]];
        }
        fn switch(&mut self, t: f64, _which: usize, positive: bool) {
            self.stiff = positive;
            self.switches.push(t);
        }
    }

    #[test]
    fn kinks_are_located_and_cost_no_accuracy() -> Result<(), ReferenceError> {
        let mut flow = Bilinear { stiff: true, switches: vec![] };
        let period = PI / W + PI;
        let end = integrate(&mut flow, [0.0, 1.0], vec![true], &[10.0 * period + 0.1])?[0];
        assert!((end[0] - (W * 0.1).sin() / W).abs() < 1e-14, "{end:?}");
        assert_eq!(flow.switches.len(), 20);
        for (k, t) in flow.switches.iter().enumerate() {
            let exact = (k / 2) as f64 * period + if k % 2 == 0 { PI / W } else { period };
            assert!((t - exact).abs() < 2e-14, "{k} {t} {exact}");
        }
        Ok(())
    }

    /// x = sin t + level dips below zero for a time far shorter than a sample.
    struct Dip {
        level: f64,
        switches: Vec<f64>,
    }

    impl Flow<1> for Dip {
        fn rate(&self, t: f64, _y: &[f64; 1]) -> [f64; 1] {
            [t.cos()]
        }
        fn indicators(&self, _t: f64, y: &[f64; 1], g: &mut Vec<f64>) {
            *g = vec![y[0] + self.level];
        }
        fn switch(&mut self, t: f64, _which: usize, _positive: bool) {
            self.switches.push(t);
        }
    }

    #[test]
    fn short_dips_are_found_and_near_misses_are_not() -> Result<(), ReferenceError> {
        let mut flow = Dip { level: 1.0 - 1e-8, switches: vec![] };
        integrate(&mut flow, [0.0], vec![true], &[TAU])?;
        assert_eq!(flow.switches.len(), 2);
        let half = (1.0 - 1e-8_f64).acos();
        for (t, exact) in flow.switches.iter().zip([1.5 * PI - half, 1.5 * PI + half]) {
            assert!((t - exact).abs() < 1e-11, "{t} {exact}");
        }
        let mut flow = Dip { level: 1.0 + 1e-8, switches: vec![] };
        integrate(&mut flow, [0.0], vec![true], &[TAU])?;
        assert!(flow.switches.is_empty());
        Ok(())
    }

    /// Kepler's ellipse of eccentricity 0.6, period 2π, needs a changing step.
    struct Kepler;
    impl Flow<4> for Kepler {
        fn rate(&self, _t: f64, y: &[f64; 4]) -> [f64; 4] {
            let r3 = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
            [y[2], y[3], -y[0] / r3, -y[1] / r3]
        }
    }

    #[test]
    fn smooth_motion_returns_after_each_period() -> Result<(), ReferenceError> {
        let start = [0.4, 0.0, 0.0, 2.0];
        for y in integrate(&mut Kepler, start, vec![], &[0.0, TAU, 5.0 * TAU])? {
            for i in 0..4 {
                assert!((y[i] - start[i]).abs() < 1e-13, "{y:?}");
            }
        }
        Ok(())
    }

    #[test]
    fn bad_requests_are_refused() {
        let times = |t: &[f64]| integrate(&mut Kepler, [0.4, 0.0, 0.0, 2.0], vec![], t);
        assert_eq!(times(&[0.5, 0.4]), Err(ReferenceError::Times { index: 1, value: 0.4 }));
        assert_eq!(times(&[-1.0]), Err(ReferenceError::Times { index: 0, value: -1.0 }));
        assert!(matches!(times(&[f64::NAN]), Err(ReferenceError::Times { index: 0, .. })));
        // Radial fall into the centre: from rest at r it takes π/√8 r^1.5.
        let fall = integrate(&mut Kepler, [0.5, 0.0, 0.0, 0.0], vec![], &[1.0]);
        assert!(matches!(fall, Err(ReferenceError::StepTooSmall { t }) if (t - PI / 8.0).abs() < 1e-3));
    }
}

//! Round numbers on axes.

/// About `wanted` round numbers within a range, ascending, with their texts.
pub(crate) fn ticks(low: f64, high: f64, wanted: usize) -> Vec<(f64, String)> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return Vec::new();
    }
    let step = round_step(span / wanted.max(1) as f64);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let count = (last - first).clamp(0.0, 1000.0) as usize;
    let values: Vec<f64> = (0..=count).map(|k| (first + k as f64) * step).collect();
    let largest = values.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    values.into_iter().map(|x| (x, text(x, step, largest))).collect()
}

/// 1, 2 or 5 times a power of ten, at least `raw`.
pub(crate) fn round_step(raw: f64) -> f64 {
    let power = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| s * power >= raw * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

/// A number with the digits that its step needs; powers of ten where all are very large or very small.
fn text(x: f64, step: f64, largest: f64) -> String {
    let x = if x.abs() < 1e-9 * step { 0.0 } else { x };
    let digits = |step: f64| (-step.log10() - 1e-9).ceil().max(0.0) as usize;
    if x == 0.0 {
        "0".into()
    } else if !(1e-3..1e5).contains(&largest) {
        let exponent = x.abs().log10().floor();
        let power = 10_f64.powf(exponent);
        format!("{}e{exponent}", minus(format!("{:.*}", digits(step / power).min(6), x / power)))
            .replace("e-", "e\u{2212}")
    } else {
        minus(format!("{:.*}", digits(step), x))
    }
}

/// A true minus sign.
pub(crate) fn minus(text: String) -> String {
    text.replace('-', "\u{2212}")
}

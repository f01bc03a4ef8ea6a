//! Colours that all eyes tell apart.

/// sRGB.
pub(crate) type Colour = [u8; 3];

/// Colours of series: Okabe and Ito's without yellow, which is faint on white; blue and vermilion first.
pub(crate) const SERIES: [Colour; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [230, 159, 0],
    [60, 60, 60],
];

/// Stops of the scale from dark blue over purple to orange: lightness rises steadily, so that it also reads in grey.
const STOPS: [[f64; 3]; 5] = [
    [30.0, 20.0, 110.0],
    [110.0, 20.0, 150.0],
    [178.0, 42.0, 120.0],
    [222.0, 92.0, 70.0],
    [245.0, 160.0, 40.0],
];

/// A colour of the scale: 0 is dark blue, 1 orange.
pub(crate) fn scale(x: f64) -> Colour {
    let x = if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.0 };
    let at = x * (STOPS.len() - 1) as f64;
    let k = (at as usize).min(STOPS.len() - 2);
    let part = at - k as f64;
    std::array::from_fn(|c| (STOPS[k][c] * (1.0 - part) + STOPS[k + 1][c] * part).round() as u8)
}

/// "#rrggbb".
pub(crate) fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A colour made lighter (towards 1) or darker (towards -1).
pub(crate) fn shade(colour: Colour, by: f64) -> Colour {
    colour.map(|c| {
        let c = f64::from(c);
        let to = if by > 0.0 { 255.0 } else { 0.0 };
        (c + (to - c) * by.abs()).round().clamp(0.0, 255.0) as u8
    })
}

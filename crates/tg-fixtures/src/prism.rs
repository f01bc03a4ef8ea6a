//! The regular tensegrity prism: n bars, 3n cables; in equilibrium without load at the twist 90° - 180°/n.

use std::f64::consts::PI;

use tg_model::{BuildError, CableId, CableLaw, MemberId, Model, ModelBuilder};

/// A prism with unit circumradius and unit height, prestressed, free in space.
#[derive(Clone, Debug)]
pub struct Prism {
    /// The model.
    pub model: Model<3>,
    /// n bars from the bottom to the top.
    pub bars: Vec<MemberId>,
    /// n bottom cables, n top cables, n vertical ones.
    pub cables: Vec<CableId>,
    /// Tension of the bottom and top cables, of the vertical ones, and force of the bars (negative) \[N\], from the
    /// balance of forces at a node.
    pub forces: [f64; 3],
}

/// A prism of `n` bars of mass 1 kg whose vertical cables carry `tension`, all cables of stiffness 1000 N/m with `law`
/// made from it. With `gravity` \[m/s²\] downwards it stands on the plane z = 0, free to slide; without it is free.
///
/// # Errors
/// Never for n ≥ 3 and a tension that 1000 N/m can carry.
pub fn prism(n: usize, tension: f64, gravity: f64, law: fn(f64) -> CableLaw) -> Result<Prism, BuildError> {
    const STIFFNESS: f64 = 1000.0;
    let step = 2.0 * PI / n as f64;
    let twist = PI / 2.0 - PI / n as f64;
    let bottom = |k: usize| [(k as f64 * step).cos(), (k as f64 * step).sin(), 0.0];
    let top = |k: usize| [(k as f64 * step + twist).cos(), (k as f64 * step + twist).sin(), 1.0];
    let distance =
        |a: [f64; 3], b: [f64; 3]| a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    // Vertical cable k runs from bottom k to top k, bar k from bottom k to top k + 1: force densities γ and -γ. The
    // radial balance of a node gives 2 sin(π/n) γ_ring = γ.
    let vertical = distance(bottom(0), top(0));
    let ring = distance(bottom(0), bottom(1));
    let density = tension / vertical;
    let forces =
        [density / (2.0 * (PI / n as f64).sin()) * ring, tension, -density * distance(bottom(0), top(1))];

    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -gravity])?;
    let bars = (0..n)
        .map(|k| b.bar(&format!("bar {k}"), 1.0, bottom(k), top(k + 1)))
        .collect::<Result<Vec<_>, _>>()?;
    let mut cables = Vec::new();
    let rest = |length: f64, tension: f64| length - tension / STIFFNESS;
    for (name, end) in [("bottom", 0), ("top", 1)] {
        for k in 0..n {
            let ends = (bars[k].node(end), bars[(k + 1) % n].node(end));
            cables.push(b.cable(
                &format!("{name} {k}"),
                ends.0,
                ends.1,
                law(STIFFNESS),
                rest(ring, forces[0]),
            )?);
        }
    }
    for k in 0..n {
        let ends = (bars[k].node(0), bars[(k + n - 1) % n].node(1));
        cables.push(b.cable(
            &format!("vertical {k}"),
            ends.0,
            ends.1,
            law(STIFFNESS),
            rest(vertical, tension),
        )?);
    }
    if gravity != 0.0 {
        for (k, bar) in bars.iter().enumerate() {
            b.support(&format!("foot {k}"), bar.node(0), 2, 0.0)?;
        }
    }
    Ok(Prism { model: b.build()?, bars, cables, forces })
}

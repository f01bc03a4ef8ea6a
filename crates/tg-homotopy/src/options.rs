//! Settings of tracker and endgame; immutable, shared by all paths.

/// Settings of the predictor-corrector tracker.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackerOptions {
    /// Largest local error of the predictor relative to ‖x‖. Small against the distance of paths, so that the corrector
    /// cannot slip to a neighbour (docs/accuracy-and-speed.md, "Predictor of paths").
    pub predictor_tolerance: f64,
    /// Largest last Newton step relative to ‖x‖. Newton's method squares it, so the point is better than that
    /// (docs/accuracy-and-speed.md, "Corrector of paths").
    pub corrector_tolerance: f64,
    /// Newton steps before the step in t is halved: two do, the third is in reserve (docs/accuracy-and-speed.md, "Corrections on
    /// paths").
    pub corrections: usize,
    /// First step in t (docs/accuracy-and-speed.md, "First step on paths").
    pub first_step: f64,
    /// Largest step in t: longer ones are refused more often (docs/accuracy-and-speed.md, "Longest step on paths").
    pub largest_step: f64,
    /// Smallest step relative to |t|, in double-double; a smaller one ends the path as failed. A millionth of the step at which
    /// the first paths were lost (docs/accuracy-and-speed.md, "Shortest step on paths").
    pub smallest_step: f64,
    /// Most steps of one path: a hundred times what those of a mechanism take (docs/accuracy-and-speed.md, "Steps of a path").
    pub steps: usize,
    /// ‖J⁻¹‖ of the equilibrated Jacobian from which double-double is used: `corrector_tolerance` over the unit
    /// roundoff would be the strict bound, observed stagnation of the corrector raises the precision earlier (docs/accuracy-and-speed.md,
    /// "Double-double on paths").
    pub double_limit: f64,
}

impl Default for TrackerOptions {
    fn default() -> Self {
        Self {
            predictor_tolerance: 1e-5,
            corrector_tolerance: 1e-9,
            corrections: 3,
            first_step: 0.02,
            largest_step: 0.2,
            smallest_step: 1e-10,
            steps: 20_000,
            double_limit: 1e7,
        }
    }
}

impl TrackerOptions {
    /// Tighter settings, for paths that ended where another one did: `level` 1, 2, …
    pub(crate) fn tightened(&self, level: u32) -> Self {
        let factor = 0.03_f64.powi(level as i32);
        Self {
            predictor_tolerance: self.predictor_tolerance * factor,
            corrector_tolerance: (self.corrector_tolerance * factor).max(1e-12),
            first_step: self.first_step * 0.3_f64.powi(level as i32),
            largest_step: self.largest_step * 0.3_f64.powi(level as i32),
            ..self.clone()
        }
    }
}

/// Settings of the Cauchy endgame.
#[derive(Clone, Debug, PartialEq)]
pub struct EndgameOptions {
    /// |t| from which patches stay fixed and t = 0 is approached (docs/accuracy-and-speed.md, "Start of the endgame").
    pub start: f64,
    /// |t| at which a path that has not reached t = 0 by ordinary steps is taken round it. Far out many turns are in vain
    /// (docs/accuracy-and-speed.md, "First turn of the endgame").
    pub first_radius: f64,
    /// Samples per turn (docs/accuracy-and-speed.md, "Samples of a turn").
    pub samples: usize,
    /// Largest winding number tried. Mechanisms have ends of two turns (docs/accuracy-and-speed.md, "Turns of the endgame"), the
    /// polynomials of the tests more.
    pub largest_winding: usize,
    /// Distance, relative to how far it went, within which a path is back where it started (docs/accuracy-and-speed.md,
    /// "Closure of a turn").
    pub closure: f64,
    /// Distance (relative to ‖x‖) of two successive estimates that are accepted (docs/accuracy-and-speed.md, "Agreement of the
    /// endgame").
    pub tolerance: f64,
    /// Smallest |t| (docs/accuracy-and-speed.md, "Smallest turn").
    pub smallest_radius: f64,
    /// |X₀|/‖X‖ of a group below which a regular end is at infinity (docs/accuracy-and-speed.md, "Regular ends at infinity").
    pub infinity: f64,
    /// The same for a singular end, which is known less well (docs/accuracy-and-speed.md, "Ends of paths at infinity").
    pub singular_infinity: f64,
}

impl Default for EndgameOptions {
    fn default() -> Self {
        Self {
            start: 0.1,
            first_radius: 1e-4,
            samples: 8,
            largest_winding: 16,
            closure: 1e-3,
            tolerance: 1e-9,
            smallest_radius: 1e-26,
            infinity: 1e-14,
            singular_infinity: 1e-7,
        }
    }
}

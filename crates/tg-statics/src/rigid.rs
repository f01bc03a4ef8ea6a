//! Motions of the whole structure as a rigid body: those that the supports leave free, and those of them along which no
//! load does work.
//!
//! The latter make every equilibrium one of a family (a structure on a plane may stand anywhere) and the tangent
//! singular; a gauge `G δq = 0` picks one. Directions along which a load does work somewhere (a pendulum under gravity)
//! belong to the equilibrium and get no gauge.

use tg_model::{At, Tensioned};
use tg_tangent::faer::Mat;
use tg_tangent::{TangentError, dense};

use crate::size::size;

/// Motions that leave a support or constraint still, per unit length of motion, or power per largest force: zero below.
const ZERO: f64 = 1e-9;
/// Finite motions at which power is looked at; a load that does none along a direction in all of them never does.
const SAMPLES: usize = 4;
/// Terms of the exponential series of a motion.
const TERMS: u32 = 24;

/// Rigid motions of a structure as coefficients of [`Tensioned::rigid_motions`], rotations per unit of length.
#[derive(Clone, Debug)]
pub(crate) struct RigidMotions {
    /// Coefficients, raw motions by free ones.
    coefficients: Mat<f64>,
}

impl RigidMotions {
    /// The rigid motions at `q` that move no prescribed coordinate and break no constraint.
    pub(crate) fn free(structure: &dyn Tensioned, q: &[f64]) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let raw = motions(structure, q);
        // An orthonormal set of fields at q: no rotation dominates far from the origin, and a straight line of points
        // has no spin.
        let (values, right) = dense::right_svd(&raw)?;
        let kept = values.iter().filter(|&&s| s > ZERO * values[0]).count();
        let scaled = Mat::from_fn(raw.ncols(), kept, |r, c| right[(r, c)] / values[c]);
        let fields = &raw * &scaled;
        let mut is_free = vec![false; q.len()];
        mechanics.free().iter().for_each(|&i| is_free[i] = true);
        let prescribed: Vec<usize> = (0..q.len()).filter(|&i| !is_free[i]).collect();
        let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
        mechanics.jacobian(q, &mut jacobian);
        let constraints = mechanics.sizes().constraints;
        let mut held = Mat::zeros(prescribed.len() + constraints, kept);
        for k in 0..kept {
            for (row, &i) in prescribed.iter().enumerate() {
                held[(row, k)] = fields[(i, k)];
            }
            for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(&jacobian) {
                let rate = a * fields[(i, k)] / mechanics.constraint_scales()[row];
                held[(prescribed.len() + row, k)] += structure.unit() * rate;
            }
        }
        Ok(Self { coefficients: &scaled * null_space(&held)? })
    }

    /// Those of them along which the force at inputs `u` never does work.
    pub(crate) fn without_work(
        &self,
        structure: &dyn Tensioned,
        q: &[f64],
        u: &[f64],
    ) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let count = self.count();
        let rest = vec![0.0; q.len()];
        let mut force = rest.clone();
        let mut power = Mat::zeros(SAMPLES, count);
        for sample in 0..SAMPLES {
            let moved = self.moved(structure, q, sample);
            let at = At { q: &moved, v: &rest, u, taut: None };
            mechanics.force(at, &mut force);
            let scale = mechanics.force_scale(at).max(f64::MIN_POSITIVE);
            for (k, field) in self.fields(structure, &moved).iter().enumerate() {
                power[(sample, k)] = field.iter().zip(&force).map(|(r, f)| r * f).sum::<f64>() / scale;
            }
        }
        Ok(Self { coefficients: &self.coefficients * null_space(&power)? })
    }

    pub(crate) fn count(&self) -> usize {
        self.coefficients.ncols()
    }

    /// The motions' velocity fields over the full coordinates at `q`.
    pub(crate) fn fields(&self, structure: &dyn Tensioned, q: &[f64]) -> Vec<Vec<f64>> {
        let fields = motions(structure, q) * &self.coefficients;
        (0..fields.ncols()).map(|k| fields.col(k).iter().copied().collect()).collect()
    }

    /// q after a finite motion: the exponential series of an affine field, of another mixture for each sample.
    fn moved(&self, structure: &dyn Tensioned, q: &[f64], sample: usize) -> Vec<f64> {
        let mix: Vec<f64> =
            (0..self.count()).map(|k| (1.0 + 1.7 * sample as f64 + 2.3 * k as f64).sin()).collect();
        let size = size(structure, q);
        let field = |x: &[f64]| {
            let mut sum = vec![0.0; x.len()];
            for (field, m) in self.fields(structure, x).iter().zip(&mix) {
                sum.iter_mut().zip(field).for_each(|(s, f)| *s += m * size * f);
            }
            sum
        };
        let origin = field(&vec![0.0; q.len()]);
        let mut moved = q.to_vec();
        let mut term = field(q);
        for order in 1..=TERMS {
            moved.iter_mut().zip(&term).for_each(|(q, t)| *q += t);
            term = field(&term);
            let factor = 1.0 / f64::from(order + 1);
            term.iter_mut().zip(&origin).for_each(|(t, o)| *t = (*t - o) * factor);
        }
        moved
    }
}

/// The velocity fields at q as columns, those of rotations per unit of length: one unit for all of them.
fn motions(structure: &dyn Tensioned, q: &[f64]) -> Mat<f64> {
    let fields = structure.rigid_motions(q);
    // D of the D(D+1)/2 are translations.
    let translations = fields.len().div_ceil(2);
    let unit = structure.unit();
    Mat::from_fn(
        q.len(),
        fields.len(),
        |r, c| if c < translations { fields[c][r] } else { fields[c][r] / unit },
    )
}

/// Orthonormal null space of a matrix with entries of order one.
fn null_space(x: &Mat<f64>) -> Result<Mat<f64>, TangentError> {
    if x.nrows() == 0 || x.ncols() == 0 {
        return Ok(Mat::identity(x.ncols(), x.ncols()));
    }
    // Rows of zeros make V square.
    let tall =
        Mat::from_fn(x.nrows().max(x.ncols()), x.ncols(), |r, c| if r < x.nrows() { x[(r, c)] } else { 0.0 });
    let (values, right) = dense::right_svd(&tall)?;
    let rank = values.iter().filter(|&&s| s > ZERO).count();
    Ok(right.subcols(rank, x.ncols() - rank).to_owned())
}

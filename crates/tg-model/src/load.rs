//! Loads: what they act on. Each is its components times its signal, and the components are inputs of the model.
//!
//! | load | components | item |
//! |---|---|---|
//! | force at a point, fixed in space (25) | D \[N\] | [`ModelBuilder::load`] |
//! | moment on a member of the plane | 1 \[N m\], counterclockwise | `ModelBuilder::<2>::moment` |
//! | moment on a member of space | 3 \[N m\], along the axes of space or of the body | `ModelBuilder::<3>::moment` |
//! | moments about the axes of a universal joint | 2 \[N m\], M_ε and M_β | `ModelBuilder::<3>::joint_moments` |
//!
//! [`ModelBuilder::load`]: crate::ModelBuilder::load

use nalgebra::SVector;

use crate::builder::{ModelBuilder, checked_signal, finite};
use crate::error::BuildError;
use crate::parts::{LoadId, LoadPart, MemberId, Place};
use crate::signal::Signal;

/// What a load is and what it acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load<const D: usize> {
    /// A force at a place, fixed in space.
    Force(Place<D>),
    /// A moment on a member.
    Moment(MemberId, MomentAxes),
    /// Moments M_ε and M_β about the axes of a universal joint that holds a bar: the first axis is x of space, the second
    /// turns about it with the bar.
    JointMoments(MemberId),
}

/// What the components of a moment refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentAxes {
    /// The axes of space.
    Space,
    /// The axes of the member's local frame, turning with it. In the plane both are one.
    Body,
}

impl<const D: usize> ModelBuilder<D> {
    /// Adds a force at a place, fixed in space: `factor(t) · force` \[N\], eq. (25).
    ///
    /// # Errors
    /// The name is taken, the force is not finite or the signal wrong.
    pub fn load(
        &mut self,
        name: &str,
        place: impl Into<Place<D>>,
        force: [f64; D],
        factor: impl Into<Signal>,
    ) -> Result<LoadId, BuildError> {
        self.add_load(name, Load::Force(place.into()), &force, "force", factor.into())
    }

    fn add_load<const N: usize>(
        &mut self,
        name: &str,
        load: Load<D>,
        components: &[f64; N],
        what: &'static str,
        factor: Signal,
    ) -> Result<LoadId, BuildError> {
        let components: SVector<f64, N> = finite("load", name, what, *components)?;
        let factor = checked_signal("load", name, factor)?;
        self.take_name("load", name)?;
        let components = components.iter().copied().collect();
        self.parts.loads.push(LoadPart { name: name.into(), load, components, factor });
        Ok(LoadId(self.parts.loads.len() - 1))
    }
}

impl ModelBuilder<2> {
    /// Adds a moment `factor(t) · moment` \[N m\] on a body or bar of the plane, counterclockwise positive.
    ///
    /// It is the gradient of `moment · θ`, θ the member's angle, and so conservative; its potential counts θ from the
    /// pose as built, in (-π, π], and jumps by 2π · moment where the member passes half a turn.
    ///
    /// # Errors
    /// The name is taken, the moment is not finite or the signal wrong; `build()` refuses moments on particles.
    pub fn moment(
        &mut self,
        name: &str,
        member: MemberId,
        moment: f64,
        factor: impl Into<Signal>,
    ) -> Result<LoadId, BuildError> {
        let load = Load::Moment(member, MomentAxes::Space);
        self.add_load(name, load, &[moment], "moment", factor.into())
    }
}

impl ModelBuilder<3> {
    /// Adds a moment `factor(t) · moment` \[N m\] on a body or bar of space, its components along the axes of space or of
    /// the body. A bar has no spin: it feels the part of the moment normal to itself, Q_u = M × u / |u|², and only axes
    /// of space make sense for it.
    ///
    /// **Neither is conservative**: the work of a constant moment depends on the path of rotations, the tangent is
    /// unsymmetric, and [`Energy`](crate::Energy) leaves the load out. Stability verdicts from the symmetric part of such
    /// a tangent tell of divergence at best, not of flutter. For moments that have a potential see
    /// [`ModelBuilder::joint_moments`].
    ///
    /// # Errors
    /// The name is taken, the moment is not finite or the signal wrong; `build()` refuses particles, and axes of the body
    /// on bars.
    pub fn moment(
        &mut self,
        name: &str,
        member: MemberId,
        axes: MomentAxes,
        moment: [f64; 3],
        factor: impl Into<Signal>,
    ) -> Result<LoadId, BuildError> {
        self.add_load(name, Load::Moment(member, axes), &moment, "moment", factor.into())
    }

    /// Adds the moments `factor(t) · (M_ε, M_β)` \[N m\] about the axes of a universal joint that holds a bar: the load of
    /// eq. (22) of the antiprism paper. With u from the bar's first to its second end and ρ² = u_y² + u_z²,
    ///
    /// ```text
    /// ε = atan2(-u_y, u_z),  β = atan2(u_x, ρ),  Q_u = ∂(M_ε ε + M_β β)/∂u
    /// ```
    /// It is conservative, -(M_ε ε + M_β β) with principal values being its potential. The joint itself adds nothing to
    /// the bar's freedom but keeps it from spinning; its reaction moment, about the normal of both axes, is
    /// -M_ε tan β where nothing else twists the bar. The axes coincide, and Q grows without bound, where the bar lies
    /// along x.
    ///
    /// # Errors
    /// The name is taken, a moment is not finite or the signal wrong; `build()` refuses members other than bars.
    pub fn joint_moments(
        &mut self,
        name: &str,
        bar: MemberId,
        moments: [f64; 2],
        factor: impl Into<Signal>,
    ) -> Result<LoadId, BuildError> {
        self.add_load(name, Load::JointMoments(bar), &moments, "moment", factor.into())
    }
}

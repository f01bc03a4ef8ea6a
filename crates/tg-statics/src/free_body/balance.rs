//! Reactions from the balances of all members.
//!
//! ```text
//! min |B x + b|²,   one block of rows per member: forces, moments about its mass centre per length
//! ```
//! x are the components of the reactions; null vectors of B are reactions that balance themselves. Of several solutions the
//! smallest is taken.

use nalgebra::{SVector, Vector3};
use tg_model::{Load, MemberId, Model};
use tg_tangent::dense;
use tg_tangent::faer::Mat;

use super::given::{bar_direction, joint_axes, member_of};
use super::{Action, FreeBody, FreeBodyError, Source, Wrench, in_space};

/// Singular values below this part of the largest are zero: those of determinate structures lie above 1e-4 in the tests,
/// rounding at 1e-16.
const RANK: f64 = 1e-9;
/// Part of a self-balanced set that a reaction may have and still count as determinate.
const DETERMINATE: f64 = 1e-7;

pub(super) struct Balance<const D: usize> {
    /// Reactions with the index of their body.
    pub(super) reactions: Vec<(usize, Action<D>)>,
    pub(super) indeterminate: usize,
}

/// A reaction before it is known.
struct Unknown<const D: usize> {
    body: usize,
    source: Source<D>,
    point: SVector<f64, D>,
}

/// What one component of x exerts: wrenches about the points of unknown reactions.
type Column<const D: usize> = Vec<(usize, Wrench<D>)>;

struct Unknowns<'a, const D: usize> {
    model: &'a Model<D>,
    q: &'a [f64],
    list: Vec<Unknown<D>>,
    columns: Vec<Column<D>>,
}

impl<const D: usize> Unknowns<'_, D> {
    fn body(&self, member: MemberId) -> Option<usize> {
        self.model.members().position(|m| m == member)
    }

    fn add(&mut self, body: usize, source: Source<D>, point: SVector<f64, D>) -> usize {
        self.list.push(Unknown { body, source, point });
        self.list.len() - 1
    }

    /// Forces of a joint: free on each member where the ground takes part, else adding up to zero.
    fn joints(&mut self) -> Result<(), FreeBodyError> {
        let model = self.model;
        for joint in model.joints() {
            let mut on_members = Vec::new();
            for &place in joint.places {
                if let Some(body) = member_of(place).and_then(|member| self.body(member)) {
                    let source = Source::Joint { name: joint.name.into() };
                    let point = model.form(place)?.eval(self.q);
                    on_members.push(self.add(body, source, point));
                }
            }
            let grounded = on_members.len() < joint.places.len();
            let (first, others) = if grounded {
                (None, on_members.as_slice())
            } else {
                match on_members.split_first() {
                    Some((first, others)) => (Some(*first), others),
                    None => continue,
                }
            };
            for &other in others {
                for axis in 0..D {
                    let unit = Wrench::force(unit(axis));
                    let mut column = vec![(other, unit)];
                    column.extend(first.map(|first| (first, unit * -1.0)));
                    self.columns.push(column);
                }
            }
        }
        Ok(())
    }

    fn supports(&mut self) -> Result<(), FreeBodyError> {
        let model = self.model;
        for support in model.supports() {
            let Some(member) = member_of(support.place) else { continue };
            let Some(body) = self.body(member) else { continue };
            let source = Source::Support { name: support.name.into() };
            let (mut point, axis) = (model.form(support.place)?.eval(self.q), unit(support.axis));
            let wrench = match support.place {
                tg_model::Place::Node(_, i) if !model.member(member).coord_type().is_point(i) => {
                    // The work f·δe on a vector of the body is that of the moment e × f.
                    let moment = in_space(&point).cross(&in_space(&axis));
                    point = model.form(member.mass_centre())?.eval(self.q);
                    Wrench::moment(moment)
                }
                _ => Wrench::force(axis),
            };
            let unknown = self.add(body, source, point);
            self.columns.push(vec![(unknown, wrench)]);
        }
        Ok(())
    }

    fn universal_joints(&mut self) -> Result<(), FreeBodyError> {
        let model = self.model;
        for load in model.loads() {
            let Load::JointMoments(bar) = model.load(load) else { continue };
            let Some(body) = self.body(bar) else { continue };
            let [_, _, normal] = joint_axes(&bar_direction(model, bar, self.q));
            let source = Source::UniversalJoint { load: model.load_name(load).into() };
            let point = model.form(bar.node(0))?.eval(self.q);
            let unknown = self.add(body, source, point);
            self.columns.push(vec![(unknown, Wrench::moment(normal))]);
        }
        Ok(())
    }
}

fn unit<const D: usize>(axis: usize) -> SVector<f64, D> {
    SVector::from_fn(|i, _| f64::from(u8::from(i == axis)))
}

/// Six numbers of a wrench, moments per length.
fn entries<const D: usize>(wrench: &Wrench<D>, length: f64) -> [f64; 6] {
    let (f, m): (_, Vector3<f64>) = (in_space(&wrench.force), wrench.moment / length);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

impl<const D: usize> Balance<D> {
    pub(super) fn new(
        model: &Model<D>,
        q: &[f64],
        bodies: &[FreeBody<D>],
        length: f64,
    ) -> Result<Self, FreeBodyError> {
        let mut unknowns = Unknowns { model, q, list: Vec::new(), columns: Vec::new() };
        unknowns.joints()?;
        unknowns.supports()?;
        unknowns.universal_joints()?;
        let Unknowns { list, columns, .. } = unknowns;
        if columns.is_empty() {
            return Ok(Self { reactions: Vec::new(), indeterminate: 0 });
        }
        let mut matrix = Mat::<f64>::zeros(6 * bodies.len(), columns.len());
        for (c, column) in columns.iter().enumerate() {
            for (unknown, wrench) in column {
                let Unknown { body, point, .. } = &list[*unknown];
                let about = wrench.moved(point, &bodies[*body].centre);
                for (r, value) in entries(&about, length).into_iter().enumerate() {
                    matrix[(6 * body + r, c)] += value;
                }
            }
        }
        let given: Vec<f64> =
            bodies.iter().flat_map(|body| entries(&body.given_about(&body.centre), length)).collect();
        let (x, null) = least_squares(&matrix, &given)?;
        let sum = |unknown: usize, x: &dyn Fn(usize) -> f64| -> Wrench<D> {
            let parts = columns.iter().enumerate().flat_map(|(c, column)| column.iter().map(move |p| (c, p)));
            parts.filter(|(_, part)| part.0 == unknown).map(|(c, part)| part.1 * x(c)).sum()
        };
        let reactions = list.iter().enumerate().map(|(k, unknown)| {
            let free = (0..null.ncols())
                .map(|n| {
                    entries(&sum(k, &|c| null[(c, n)]), length)
                        .into_iter()
                        .fold(0.0, |a: f64, x| a.max(x.abs()))
                })
                .fold(0.0, f64::max);
            let action = Action {
                source: unknown.source.clone(),
                point: unknown.point,
                wrench: sum(k, &|c| x[c]),
                determinate: free <= DETERMINATE,
            };
            (unknown.body, action)
        });
        Ok(Self { reactions: reactions.collect(), indeterminate: null.ncols() })
    }
}

/// The smallest x that minimises |B x + b|, and an orthonormal null space of B.
fn least_squares(matrix: &Mat<f64>, b: &[f64]) -> Result<(Vec<f64>, Mat<f64>), FreeBodyError> {
    let svd = dense::svd(matrix)?;
    let columns = matrix.ncols();
    let rank = svd.values.iter().filter(|&&s| s > RANK * svd.values[0]).count();
    let mut x = vec![0.0; columns];
    for k in 0..rank {
        let along: f64 = b.iter().enumerate().map(|(r, b)| svd.left[(r, k)] * b).sum();
        let share = -along / svd.values[k];
        x.iter_mut().enumerate().for_each(|(c, x)| *x += share * svd.right[(c, k)]);
    }
    Ok((x, svd.right.subcols(rank, columns - rank).to_owned()))
}

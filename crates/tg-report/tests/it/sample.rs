//! A structure that exists nowhere: two bars, a body, a particle, three cables; it turns about z.

use tg_report::{CableFrame, CableOutline, Channel, Frame, MemberOutline, Outline, Placement, Table};

pub(crate) fn outline() -> Outline {
    let mut outline = Outline::new(3);
    outline.members = vec![
        MemberOutline::bar("bar 1", [[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]], 0.02),
        MemberOutline::bar("bar <2> & \"last\"", [[-0.4, 0.0, 0.0], [0.4, 0.0, 0.0]], 0.0),
        MemberOutline::body(
            "tetrahedron",
            vec![[0.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.4]],
            vec![[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [1, 3]],
            vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        ),
        MemberOutline::particle("weight", 0.05),
    ];
    let cable =
        |name: &str, group: Option<&str>| CableOutline { name: name.into(), group: group.map(Into::into) };
    outline.cables =
        vec![cable("cable 1", Some("guys")), cable("cable 2", Some("guys")), cable("hoist", None)];
    outline
}

pub(crate) fn frame(time: f64) -> Frame {
    let (sin, cos) = time.sin_cos();
    let rotation = [0.0, 0.0, (time / 2.0).sin(), (time / 2.0).cos()];
    let poses: Vec<Placement> =
        [[0.0, 0.0, 0.5], [cos, sin, 1.0], [-0.7 * sin, 0.7 * cos, 0.0], [0.3, 0.2, 1.5 + 0.1 * sin]]
            .into_iter()
            .map(|position| Placement { position, rotation })
            .collect();
    let cable = |a: [f64; 3], b: [f64; 3], rest: f64| {
        let length = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        let tension = 100.0 * (length - rest);
        CableFrame { ends: [a, b], tension: tension.max(0.0), length, rest, slack: tension < 0.0 }
    };
    let top = poses[0].apply([0.0, 0.0, 0.5]);
    let cables = vec![
        cable([1.0, -0.5, 0.0], top, 1.3),
        cable(top, poses[1].apply([0.4, 0.0, 0.0]), 1.2),
        cable(poses[3].position, poses[2].apply([0.0, 0.0, 0.4]), 1.45),
    ];
    Frame { time, poses, cables }
}

pub(crate) fn frames(count: usize) -> Vec<Frame> {
    (0..count).map(|k| frame(0.1 * k as f64)).collect()
}

pub(crate) fn channels() -> Vec<Channel> {
    vec![
        Channel::time(),
        Channel::new("kinetic", "J", "energy"),
        Channel::new("total", "J", "energy"),
        Channel::new("cable 1.tension", "N", "tension"),
        Channel::new("cable 2.tension", "N", "tension"),
        Channel::new("cable 1.slack", "", "slack"),
        Channel::new("tip.x", "m", "point"),
        Channel::new("tip's ü, \"angle\"", "rad", "point"),
    ]
}

pub(crate) fn row(k: usize) -> Vec<f64> {
    let t = 0.01 * k as f64;
    let slack = f64::from(u8::from(k % 50 < 10));
    vec![t, t.sin().powi(2), 1.0 + 1e-9 * t, 10.0 / 3.0 + t.cos(), 1e-7 * t, slack, -t.exp(), t * 1e18]
}

pub(crate) fn table(rows: usize) -> Table {
    let mut table = Table::new(channels());
    for k in 0..rows {
        table.push(&row(k)).unwrap();
    }
    table
}

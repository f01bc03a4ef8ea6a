//! Keyframes of members and cables.

use crate::frame::Frame;
use crate::vector::{Quaternion, norm, normalised, shortest, sub, turn, unit};

/// Placement, turn and stretch of a node at each frame.
pub(super) struct Track {
    pub(super) translation: Vec<[f32; 3]>,
    pub(super) rotation: Vec<[f32; 4]>,
    pub(super) scale: Vec<[f32; 3]>,
}

/// Frames with finite numbers, each later than the one before.
pub(super) fn usable(frames: &[Frame]) -> Vec<&Frame> {
    let mut usable: Vec<&Frame> = Vec::with_capacity(frames.len());
    for frame in frames.iter().filter(|f| f.is_finite()) {
        let start = usable.first().map_or(0.0, |f| f.time);
        let last = usable.last().map(|f| (f.time - start) as f32);
        if last.is_none_or(|last| (frame.time - start) as f32 > last) {
            usable.push(frame);
        }
    }
    usable
}

/// Times from the first frame on \[s\].
pub(super) fn times(frames: &[&Frame]) -> Vec<f32> {
    frames.iter().map(|f| (f.time - frames[0].time) as f32).collect()
}

impl Track {
    pub(super) fn of_member(frames: &[&Frame], member: usize) -> Self {
        let mut track = Self { translation: Vec::new(), rotation: Vec::new(), scale: vec![[1.0; 3]] };
        let mut last = [0.0; 4];
        for pose in frames.iter().map(|f| f.poses[member]) {
            // q and -q are one rotation: the nearer one makes the shorter way between frames.
            let q = normalised(pose.rotation);
            let same_side = q.iter().zip(&last).map(|(a, b)| a * b).sum::<f64>() >= 0.0;
            last = if same_side { q } else { q.map(|x| -x) };
            track.push(pose.position, last);
        }
        track
    }

    pub(super) fn of_cable(frames: &[&Frame], cable: usize, radius: f64) -> Self {
        let mut track = Self { translation: Vec::new(), rotation: Vec::new(), scale: Vec::new() };
        let (mut direction, mut rotation) = ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0]);
        for [a, b] in frames.iter().map(|f| f.cables[cable].ends) {
            let along = sub(b, a);
            // The shortest turn from frame to frame: no jump where a cable points back along z.
            if let Some(next) = unit(along) {
                rotation = normalised(turn(shortest(direction, next), rotation));
                direction = next;
            }
            track.push(a, rotation);
            track.scale.push([radius, radius, norm(along)].map(|x| x as f32));
        }
        track
    }

    fn push(&mut self, position: [f64; 3], rotation: Quaternion) {
        self.translation.push(position.map(|x| x as f32));
        self.rotation.push(rotation.map(|x| x as f32));
    }
}

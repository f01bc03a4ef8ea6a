//! What came of a question, under guard against panics and endless loops.

use std::any::Any;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use tg_integrate::Turning;

/// Time for one question.
const PATIENCE: Duration = Duration::from_secs(600);
/// Time for a cancelled question to come back.
const GRACE: Duration = Duration::from_secs(5);

/// Angle by which the acceleration may turn in a step of a second-order scheme for a hundredth of error in a radian \[rad\].
const RESOLVED: f64 = 0.3;

/// What came of a question.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// The answer is right: its error stays within the limit.
    Right { error: f64, limit: f64 },
    /// A typed error, in its words.
    Refused(String),
    /// An answer that is not right, and its report says so, in these words.
    Told { error: f64, limit: f64, words: String },
    /// An answer that is not right, and nothing said so.
    Wrong { error: f64, limit: f64 },
    /// A panic, in its words.
    Panicked(String),
    /// No answer in time.
    Endless,
}

impl Verdict {
    /// An error of an answer against its limit, both in the same unit; NaN is wrong.
    pub(crate) fn judge(error: f64, limit: f64) -> Self {
        if error <= limit { Self::Right { error, limit } } else { Self::Wrong { error, limit } }
    }

    /// An answer's error, or the refusal.
    pub(crate) fn of<E: Display>(answer: Result<f64, E>, limit: f64) -> Self {
        match answer {
            Ok(error) => Self::judge(error, limit),
            Err(refusal) => Self::Refused(refusal.to_string()),
        }
    }

    /// As [`Verdict::of`] for a motion that was watched by [`Turning`], which tells that steps are too long.
    pub(crate) fn of_motion<E: Display>(answer: Result<(f64, Turning), E>, limit: f64) -> Self {
        match answer {
            Ok((error, turning)) if error > limit && turning.angle() > RESOLVED => {
                let words = format!("`Turning`: the acceleration turns by more than {RESOLVED} rad a step");
                Self::Told { error, limit, words }
            }
            answer => Self::of(answer.map(|(error, _)| error), limit),
        }
    }

    /// Right, told or refused.
    pub(crate) fn holds(&self) -> bool {
        matches!(self, Self::Right { .. } | Self::Told { .. } | Self::Refused(_))
    }
}

/// Asks in a thread of its own.
pub(super) fn guarded(ask: Box<dyn FnOnce(&AtomicBool) -> Verdict + Send>) -> Verdict {
    let (sender, receiver) = channel();
    let over = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&over);
    thread::spawn(move || {
        let verdict = catch_unwind(AssertUnwindSafe(|| ask(&flag)))
            .unwrap_or_else(|panic| Verdict::Panicked(words(panic.as_ref())));
        // Nobody listens any more if the time is over.
        let _ = sender.send(verdict);
    });
    match receiver.recv_timeout(PATIENCE) {
        Ok(verdict) => verdict,
        Err(RecvTimeoutError::Disconnected) => Verdict::Panicked("the thread ended without a word".into()),
        Err(RecvTimeoutError::Timeout) => {
            over.store(true, Ordering::Relaxed);
            // Whether it comes back or not, it was too late; this only spares the processor.
            let _ = receiver.recv_timeout(GRACE);
            Verdict::Endless
        }
    }
}

fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message").to_string()
}

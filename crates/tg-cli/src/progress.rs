//! Progress on stderr where that is a terminal, and Ctrl-C.

use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::answer::Failure;

/// Set by Ctrl-C; long work looks at it.
pub(crate) static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// From now on the first Ctrl-C asks for an orderly end, the second ends the program.
pub(crate) fn watch_for_interrupts() -> Result<(), Failure> {
    let watch = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Relaxed) {
            std::process::exit(130);
        }
    });
    watch.map_err(|error| Failure::Usage(format!("Ctrl-C cannot be watched: {error}")))
}

/// A bar that fills; invisible where stderr is no terminal.
pub(crate) fn bar(steps: u64, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(steps).with_style(style)
}

/// Something turns while work of unknown length goes on; invisible where stderr is no terminal.
pub(crate) fn spinner(message: &'static str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner().with_message(message);
    spinner.enable_steady_tick(Duration::from_millis(100));
    spinner
}

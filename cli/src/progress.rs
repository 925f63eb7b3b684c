//! The progress bar: on standard error, and only if a person sits there.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use netmesh::{Phase, Progress};
use std::io::{IsTerminal, stderr};

const STEPS: f64 = 1000.0;
const TEMPLATE: &str = "{prefix:>10} [{bar:32}] {percent:>3} %  {msg}";

/// A bar that shows [`Progress`] reports; hidden if `wanted` is false or nobody watches.
pub struct Bar {
    bar: ProgressBar,
}

impl Bar {
    pub fn new(wanted: bool) -> Self {
        let target = match wanted && stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target);
        let style = ProgressStyle::with_template(TEMPLATE).unwrap_or_else(|_| {
            debug_assert!(false, "the template is a constant that parses");
            ProgressStyle::default_bar()
        });
        bar.set_style(style.progress_chars("=> "));
        Self { bar }
    }

    pub fn show(&self, progress: &Progress) {
        self.bar.set_prefix(phase_name(progress.phase));
        if progress.fraction >= 0.0 {
            self.bar.set_position((progress.fraction * STEPS) as u64);
        }
        self.bar.set_message(format!(
            "{} inputs in, {} vertices, {} simplices",
            progress.inputs_inserted, progress.vertices, progress.simplices
        ));
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn phase_name(phase: Phase) -> &'static str {
    match phase {
        Phase::Prepare => "preparing",
        Phase::Insert => "inserting",
        Phase::Finish => "finishing",
        Phase::Export => "writing",
    }
}

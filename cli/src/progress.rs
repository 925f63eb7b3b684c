//! Progress: on standard error, and only if a person sits there. Every stage of the program shows
//! itself, and its elapsed time moves on though the stage itself tells nothing.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use netmesh::Phase;
use std::io::{IsTerminal, stderr};
use std::time::Duration;

const STEPS: f64 = 1000.0;
const BAR: &str = "{prefix:>10} [{bar:32}] {percent:>3} %  {elapsed}  {msg}";
const SPINNER: &str = "{prefix:>10} {spinner} {elapsed}";
const TICK: Duration = Duration::from_millis(100);

/// Shows stages, or nothing where nobody wants to see them or nobody watches.
pub struct Display {
    is_visible: bool,
}

impl Display {
    pub fn new(wanted: bool) -> Self {
        Self { is_visible: wanted && stderr().is_terminal() }
    }

    /// Returns a stage that cannot tell how far it is.
    pub fn stage(&self, name: &'static str) -> Stage {
        self.shown(name, ProgressBar::new_spinner(), SPINNER)
    }

    /// Returns a stage that reports its [`netmesh::Progress`].
    pub fn meshing(&self) -> Stage {
        self.shown(phase_name(Phase::Prepare), ProgressBar::new(STEPS as u64), BAR)
    }

    fn shown(&self, name: &'static str, bar: ProgressBar, template: &str) -> Stage {
        let target = match self.is_visible {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        bar.set_draw_target(target);
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| {
            debug_assert!(false, "the template is a constant that parses");
            ProgressStyle::default_bar()
        });
        bar.set_style(style.progress_chars("=> "));
        bar.set_prefix(name);
        if self.is_visible {
            bar.enable_steady_tick(TICK);
        }
        Stage { bar }
    }
}

/// A stage that is under way; its line is cleared at its end.
pub struct Stage {
    bar: ProgressBar,
}

impl Stage {
    pub fn show(&self, progress: &netmesh::Progress) {
        self.bar.set_prefix(phase_name(progress.phase));
        if progress.fraction >= 0.0 {
            self.bar.set_position((progress.fraction * STEPS) as u64);
        }
        self.bar.set_message(format!(
            "{} inputs in, {} vertices, {} simplices",
            progress.inputs_inserted, progress.vertices, progress.simplices
        ));
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
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

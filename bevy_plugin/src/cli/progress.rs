//! A bar that shows what a bake does.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use radiosity::progress::{Progress, Snapshot, Stage};

/// Between two lines where no terminal shows a bar.
const LINES_APART: Duration = Duration::from_secs(30);

/// Shows progress on a terminal as a bar, elsewhere as a line now and then.
pub(super) enum Display {
    /// On a terminal.
    Bar(ProgressBar),
    /// In a log: the last stage that was told, and when.
    Lines(Option<(Stage, Instant)>),
}

impl Display {
    /// A bar if standard error is a terminal.
    pub fn new() -> Self {
        if !stderr().is_terminal() {
            return Self::Lines(None);
        }
        let bar = ProgressBar::new(1000);
        if let Ok(style) = ProgressStyle::with_template("{prefix:>9} {wide_bar} {percent:>3} % {msg}") {
            bar.set_style(style);
        }
        Self::Bar(bar)
    }

    /// Shows what is being done.
    pub fn update(&mut self, progress: &Progress) {
        let snapshot = progress.snapshot();
        match self {
            Self::Bar(bar) => {
                bar.set_prefix(snapshot.stage.name());
                bar.set_message(remaining(&snapshot));
                bar.set_position((snapshot.done * 1000.0) as u64);
            }
            Self::Lines(last) => {
                let is_news = last.is_none_or(|(stage, told)| stage != snapshot.stage || told.elapsed() > LINES_APART);
                if is_news {
                    *last = Some((snapshot.stage, Instant::now()));
                    eprintln!("{}: {:.0} % {}", snapshot.stage.name(), snapshot.done * 100.0, remaining(&snapshot));
                }
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn remaining(snapshot: &Snapshot) -> String {
    let seconds = snapshot.remaining_seconds;
    match seconds {
        _ if !seconds.is_finite() || snapshot.done < 0.02 => String::new(),
        0.0..90.0 => format!("{seconds:.0} s left"),
        _ => format!("{:.0} min left", seconds / 60.0),
    }
}

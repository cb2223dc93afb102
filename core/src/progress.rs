//! What a running bake is doing, seen and stopped from another thread.

use core::fmt;
use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use alloc::boxed::Box;

/// The steps of a bake in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Charts for meshes that have none, and their places in the images.
    Unwrap,
    /// Triangles into a hierarchy, charts into texels.
    Geometry,
    /// Light that arrives straight from a source, texel by texel.
    Direct,
    /// Form factors between patches.
    Transport,
    /// The radiosity equation.
    Solve,
    /// Light that arrives from all other surfaces.
    Gather,
    /// Repairs at borders and of invalid texels.
    Finish,
    /// Paths of light that a bake is held against or that make a picture: no part of a bake, but all that is done.
    Paths,
}

impl Stage {
    /// All stages of a bake in their order.
    pub const ALL: [Self; 7] =
        [Self::Unwrap, Self::Geometry, Self::Direct, Self::Transport, Self::Solve, Self::Gather, Self::Finish];

    /// In lower case, for reports and bars.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unwrap => "unwrap",
            Self::Geometry => "geometry",
            Self::Direct => "direct",
            Self::Transport => "transport",
            Self::Solve => "solve",
            Self::Gather => "gather",
            Self::Finish => "finish",
            Self::Paths => "paths",
        }
    }
}

/// Shared between the bake, which writes, and whoever watches or cancels it.
pub struct Progress {
    /// The stage in the upper 8 bits, the share of it that is done in the others, so that both change at once.
    reached: AtomicU32,
    part: AtomicU32,
    parts: AtomicU32,
    group: AtomicU32,
    groups: AtomicU32,
    cancelled: AtomicBool,
    clock: Box<dyn Fn() -> f64 + Send + Sync>,
}

/// One look at a running bake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapshot {
    /// What is being done.
    pub stage: Stage,
    /// Share of this stage that is done, in `[0, 1]`.
    pub stage_done: f32,
    /// Share of the whole bake that is done, in `[0, 1]`; an estimate.
    pub done: f32,
    /// Seconds until the end; an estimate, infinite at the start.
    pub remaining_seconds: f32,
}

/// The bake was cancelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

impl fmt::Display for Cancelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("cancelled")
    }
}

impl core::error::Error for Cancelled {}

/// Where in the whole bake each stage starts, from typical times; the last entry is the end.
const START: [f32; 8] = [0.0, 0.05, 0.08, 0.40, 0.50, 0.51, 0.98, 1.0];

const SHARE_BITS: u32 = 24;
/// All of a stage, in units of the share that is done.
const WHOLE: u32 = (1 << SHARE_BITS) - 1;

#[cfg(feature = "std")]
impl Default for Progress {
    /// Watches a bake that starts now by the clock of the machine.
    fn default() -> Self {
        let start = std::time::Instant::now();
        Self::with_clock(move || start.elapsed().as_secs_f64())
    }
}

impl Progress {
    /// Watches a bake by a clock that tells the seconds since some moment.
    pub fn with_clock(clock: impl Fn() -> f64 + Send + Sync + 'static) -> Self {
        Self {
            reached: AtomicU32::new(0),
            part: AtomicU32::new(0),
            parts: AtomicU32::new(1),
            group: AtomicU32::new(0),
            groups: AtomicU32::new(1),
            cancelled: AtomicBool::new(false),
            clock: Box::new(clock),
        }
    }

    /// Makes the bake return at the next opportunity, within a tenth of a second.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// What the bake is doing now.
    pub fn snapshot(&self) -> Snapshot {
        let reached = self.reached.load(Ordering::Relaxed);
        let index = (reached >> SHARE_BITS) as usize;
        let stage_done = (reached & WHOLE) as f32 / WHOLE as f32;
        let (stage, done) = match Stage::ALL.get(index) {
            Some(&stage) => (stage, START[index] + (START[index + 1] - START[index]) * stage_done),
            None => (Stage::Paths, stage_done),
        };
        let seconds = (self.clock)() as f32;
        let remaining_seconds = if done > 0.0 { seconds * (1.0 - done) / done } else { f32::INFINITY };
        Snapshot { stage, stage_done, done, remaining_seconds }
    }

    /// Seconds on the clock.
    pub fn seconds(&self) -> f64 {
        (self.clock)()
    }

    /// Tells that a stage begins.
    pub fn enter(&self, stage: Stage) {
        self.enter_group(0, 1);
        self.reached.store((stage as u32) << SHARE_BITS, Ordering::Relaxed);
    }

    /// Tells that one of several equal groups of parts of the stage begins, counted from 0.
    pub fn enter_group(&self, group: usize, groups: usize) {
        self.enter_part(0, 1);
        self.group.store(group as u32, Ordering::Relaxed);
        self.groups.store(groups as u32, Ordering::Relaxed);
    }

    /// Tells that one of several equal parts of the group begins, counted from 0.
    pub fn enter_part(&self, part: usize, parts: usize) {
        self.part.store(part as u32, Ordering::Relaxed);
        self.parts.store(parts as u32, Ordering::Relaxed);
    }

    /// Tells the share of the part of the stage that is done, in `[0, 1]`, and whether to go on. What is done stays done:
    /// a smaller share than before changes nothing.
    pub fn advance(&self, done: f32) -> Result<(), Cancelled> {
        let (part, parts) = (self.part.load(Ordering::Relaxed), self.parts.load(Ordering::Relaxed));
        let (group, groups) = (self.group.load(Ordering::Relaxed), self.groups.load(Ordering::Relaxed));
        let done = (part as f32 + done.clamp(0.0, 1.0)) / parts.max(1) as f32;
        let done = (group as f32 + done.min(1.0)) / groups.max(1) as f32;
        let stage = self.reached.load(Ordering::Relaxed) & !WHOLE;
        self.reached.fetch_max(stage | (done.min(1.0) * WHOLE as f32) as u32, Ordering::Relaxed);
        self.check()
    }

    /// Whether to go on.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.cancelled.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts, and steps of a stage that each count from 0, never turn a bar back.
    #[test]
    fn what_is_done_stays_done() {
        let progress = Progress::with_clock(|| 1.0);
        let mut before = 0.0;
        let mut assert_not_back = || {
            let now = progress.snapshot();
            assert!(now.done >= before && now.stage_done <= 1.0, "{now:?} after {before}");
            before = now.done;
        };
        for stage in Stage::ALL {
            progress.enter(stage);
            assert_not_back();
            for group in 0..3 {
                progress.enter_group(group, 3);
                for (part, share) in [(0, 0.7), (0, 1.0), (1, 0.0), (1, 1.0), (0, 0.2)] {
                    progress.enter_part(part, 2);
                    progress.advance(share).unwrap();
                    assert_not_back();
                }
            }
            assert_eq!(progress.snapshot().stage_done, 1.0);
        }
        assert_eq!(progress.snapshot().done, 1.0);
    }

    /// Paths are no part of a bake: half of them after 3 s leave as long a time.
    #[test]
    fn paths_are_a_whole() {
        let progress = Progress::with_clock(|| 3.0);
        progress.enter(Stage::Paths);
        progress.enter_group(1, 4);
        progress.advance(1.0).unwrap();
        let now = progress.snapshot();
        assert_eq!((now.stage, now.stage_done), (Stage::Paths, now.done));
        assert!((now.done - 0.5).abs() < 1e-6 && (now.remaining_seconds - 3.0).abs() < 1e-4, "{now:?}");
    }
}

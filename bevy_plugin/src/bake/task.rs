//! A bake on a thread of its own, which starts the worker threads: Bevy's pools are too small and stay free.

use std::sync::Arc;
use std::thread::{Builder, JoinHandle};

use radiosity::bake::{Bake, BakeError, BakeSettings};
use radiosity::progress::{Progress, Snapshot};

use super::Collected;

/// A bake that is under way. Dropping it cancels it.
pub(crate) struct BakeTask {
    progress: Arc<Progress>,
    thread: Option<JoinHandle<Result<Bake, BakeError>>>,
}

impl BakeTask {
    /// Starts to bake.
    pub(crate) fn start(collected: Arc<Collected>, settings: BakeSettings) -> Result<Self, BakeError> {
        let progress = Arc::new(Progress::default());
        let shared = progress.clone();
        let work = move || radiosity::bake::bake(&collected.scene, &settings, &shared);
        let thread = Builder::new().name("radiosity bake".into()).spawn(work);
        let thread = thread.map_err(|error| BakeError::Invalid(format!("no thread for the bake: {error}")))?;
        Ok(Self { progress, thread: Some(thread) })
    }

    /// What the bake is doing now.
    pub(crate) fn snapshot(&self) -> Snapshot {
        self.progress.snapshot()
    }

    /// Makes the bake end soon, with `BakeError::Cancelled`.
    pub(crate) fn cancel(&self) {
        self.progress.cancel();
    }

    /// The result, once, when it is there.
    pub(crate) fn take_result(&mut self) -> Option<Result<Bake, BakeError>> {
        let thread = self.thread.take_if(|thread| thread.is_finished())?;
        let panicked =
            || BakeError::Invalid("the bake panicked; please report the message above with the scene".into());
        Some(thread.join().unwrap_or_else(|_| Err(panicked())))
    }
}

impl Drop for BakeTask {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

//! The threads of rayon.

use core::ops::Range;
use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;

use alloc::vec::Vec;

use rayon::prelude::*;

use crate::progress::{Cancelled, Progress};

/// More threads than this only take memory and time to start.
const MOST_THREADS: usize = 256;

/// Chunks whose results are there twice, apart and put together.
const WAVE: usize = 1024;

/// How often a bake that waits looks whether it was cancelled.
const WAIT: Duration = Duration::from_millis(2);

/// The threads that work on a bake.
pub struct Workers(rayon::ThreadPool);

impl Workers {
    /// As many threads as asked for, at most 256; 0: one for each core.
    ///
    /// # Panics
    ///
    /// Where the machine refuses to start a thread.
    pub fn new(threads: usize) -> Self {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.min(MOST_THREADS)).build();
        Self(pool.expect("the machine can start threads"))
    }

    /// How many threads work.
    pub fn threads(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Runs a task that brings parallel work of its own on these threads.
    pub fn run<T: Send>(&self, task: impl FnOnce() -> T + Send) -> T {
        self.0.install(task)
    }

    /// Runs a task that cannot be interrupted. Where the bake is cancelled meanwhile it is left to end by itself.
    ///
    /// # Panics
    ///
    /// Where the task does.
    pub fn run_apart<T: Send + 'static>(
        &self,
        progress: &Progress,
        task: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Cancelled> {
        let apart = std::thread::spawn(task);
        while !apart.is_finished() {
            progress.check()?;
            std::thread::sleep(WAIT);
        }
        Ok(apart.join().expect("the task ends well"))
    }

    /// The results of `task` for `0..count`, in order, computed `chunk` at a time.
    pub fn map<T: Send>(
        &self,
        count: usize,
        chunk: usize,
        progress: &Progress,
        task: impl Fn(Range<usize>) -> Vec<T> + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        let done = AtomicUsize::new(0);
        let one = |index: usize| {
            progress.advance(done.load(Ordering::Relaxed) as f32 / count as f32)?;
            let range = index * chunk..((index + 1) * chunk).min(count);
            done.fetch_add(range.len(), Ordering::Relaxed);
            Ok(task(range))
        };
        let chunks = count.div_ceil(chunk);
        let mut results = Vec::with_capacity(count);
        for first in (0..chunks).step_by(WAVE) {
            let wave = first..(first + WAVE).min(chunks);
            let parts: Result<Vec<Vec<T>>, Cancelled> = self.0.install(|| wave.into_par_iter().map(one).collect());
            parts?.into_iter().for_each(|part| results.extend(part));
        }
        Ok(results)
    }

    /// Changes a list `chunk` entries at a time; `task` gets the index of the first of them. Its results, in order.
    pub fn update<T: Send, S: Send>(
        &self,
        list: &mut [T],
        chunk: usize,
        progress: &Progress,
        task: impl Fn(usize, &mut [T]) -> S + Sync,
    ) -> Result<Vec<S>, Cancelled> {
        progress.check()?;
        let chunks = |(index, part): (usize, &mut [T])| task(index * chunk, part);
        Ok(self.0.install(|| list.par_chunks_mut(chunk).enumerate().map(chunks).collect()))
    }
}

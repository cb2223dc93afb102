//! One thread, where there is no other.

use core::ops::Range;

use alloc::vec::Vec;

use crate::progress::{Cancelled, Progress};

/// The threads that work on a bake: here, the one that calls.
pub struct Workers;

impl Workers {
    /// There is one thread, whatever is asked for.
    pub fn new(_threads: usize) -> Self {
        Self
    }

    /// How many threads work.
    pub fn threads(&self) -> usize {
        1
    }

    /// Runs a task.
    pub fn run<T: Send>(&self, task: impl FnOnce() -> T + Send) -> T {
        task()
    }

    /// Runs a task that cannot be interrupted.
    pub fn run_apart<T: Send + 'static>(
        &self,
        progress: &Progress,
        task: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Cancelled> {
        progress.check()?;
        Ok(task())
    }

    /// The results of `task` for `0..count`, in order, computed `chunk` at a time.
    pub fn map<T: Send>(
        &self,
        count: usize,
        chunk: usize,
        progress: &Progress,
        task: impl Fn(Range<usize>) -> Vec<T> + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        let mut results = Vec::with_capacity(count);
        for start in (0..count).step_by(chunk) {
            progress.advance(start as f32 / count as f32)?;
            results.extend(task(start..(start + chunk).min(count)));
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
        Ok(list.chunks_mut(chunk).enumerate().map(|(index, part)| task(index * chunk, part)).collect())
    }
}

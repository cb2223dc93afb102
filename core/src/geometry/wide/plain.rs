//! Where no wider instructions are known.

use super::lanes::Plain;
use super::{Task, run_task};

/// What every processor has.
#[derive(Clone, Copy, Debug)]
pub struct Level;

impl Level {
    pub fn new() -> Self {
        Self
    }

    /// What every processor has.
    #[cfg(test)]
    pub fn plain() -> Self {
        Self
    }

    /// Runs a task.
    #[inline]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        run_task(task, Plain)
    }
}

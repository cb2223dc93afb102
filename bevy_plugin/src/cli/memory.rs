//! What the process has of the memory that a bake may use.

use std::fs;

use radiosity::bake::BakeError;
use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System};

use super::error::CliError;

/// The memory that may be used, and what the loaded scene and the program have of it already, in bytes.
pub(super) struct Budget {
    allowed: u64,
    /// What the process has now.
    pub resident: u64,
}

impl Budget {
    /// Looks what the process has now.
    ///
    /// # Errors
    ///
    /// That is already more than allowed.
    pub fn new(allowed: u64) -> Result<Self, CliError> {
        let resident = resident_bytes();
        if resident < allowed {
            return Ok(Self { allowed, resident });
        }
        Err(CliError::new(format!(
            "the loaded scene has {} MiB of memory and the bake may use {} MiB; allow more by --memory",
            resident >> 20,
            allowed >> 20
        )))
    }

    /// What is left for the bake.
    pub fn left(&self) -> u64 {
        self.allowed - self.resident
    }

    /// The error of a bake with the numbers of the whole process.
    pub fn add(&self, error: BakeError) -> BakeError {
        match error {
            BakeError::OutOfMemory { needed, allowed } => {
                BakeError::OutOfMemory { needed: needed + self.resident, allowed: allowed + self.resident }
            }
            other => other,
        }
    }
}

/// The most memory that this process had; where the system does not tell, what it has now.
pub(super) fn peak_bytes() -> u64 {
    status("VmHWM:").unwrap_or_else(resident_bytes)
}

/// The memory that this process has; 0 where the system does not tell.
fn resident_bytes() -> u64 {
    let Ok(own) = sysinfo::get_current_pid() else { return 0 };
    let mut system = System::new();
    let memory = ProcessRefreshKind::nothing().with_memory();
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), false, memory);
    system.process(own).map_or(0, |process| process.memory())
}

/// A line of what Linux says about this process, in bytes.
fn status(key: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let kibibytes = status.lines().find_map(|line| line.strip_prefix(key)?.trim().strip_suffix("kB"))?;
    Some(kibibytes.trim().parse::<u64>().ok()? << 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of the user and of the error are those of the whole process.
    #[test]
    fn what_is_there_already_counts() {
        assert!(Budget::new(1 << 10).is_err());
        let budget = Budget::new(1 << 50).unwrap();
        assert!(budget.resident > 1 << 20 && budget.left() + budget.resident == 1 << 50);
        let error = budget.add(BakeError::OutOfMemory { needed: 1 << 51, allowed: budget.left() });
        assert_eq!(error, BakeError::OutOfMemory { needed: (1 << 51) + budget.resident, allowed: 1 << 50 });
    }
}

//! What the process has of the memory, where the system tells.

use std::fs;

/// Forgets the most that was ever used; returns what is used now, in bytes. 0 where the system does not tell.
pub fn start() -> u64 {
    // Without the right to reset it the most ever used stays, which is too much, never too little.
    drop(fs::write("/proc/self/clear_refs", "5"));
    status("VmRSS:")
}

/// The most that was used since the start.
pub fn peak() -> u64 {
    status("VmHWM:")
}

/// A line of what Linux says about this process, in bytes.
fn status(key: &str) -> u64 {
    let text = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix(key)?.trim().strip_suffix("kB"));
    line.and_then(|kibibytes| kibibytes.trim().parse::<u64>().ok()).unwrap_or(0) << 10
}

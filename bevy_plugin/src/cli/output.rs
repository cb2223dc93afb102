//! Files that appear all together at the end or not at all.

use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::error::CliError;

/// The temporary files of this process. Who makes, renames or removes one holds the lock.
static PARTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Removes all temporary files and ends the process as one that was cancelled.
pub(super) fn clean_up_and_exit() -> ! {
    let parts = parts();
    for part in parts.iter() {
        // It may not be there, where writing it failed.
        drop(fs::remove_file(part));
    }
    // The lock is still held: nobody can make another one.
    process::exit(130)
}

fn parts() -> MutexGuard<'static, Vec<PathBuf>> {
    PARTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Files on their way into a folder, under other names until all are whole.
pub(super) struct Staging<'a> {
    folder: PathBuf,
    is_new: bool,
    names: Vec<String>,
    /// Whether the user wants it stopped.
    pub interrupted: &'a AtomicBool,
}

impl<'a> Staging<'a> {
    /// Makes the folder where there is none, and sees to it that files can be written there.
    ///
    /// Nothing is written any more, and nothing gets its name, once `interrupted` is true.
    pub fn new(folder: &Path, interrupted: &'a AtomicBool) -> Result<Self, CliError> {
        let shown = folder.display();
        let failed =
            |error| CliError::new(format!("cannot write to the folder {shown}: {error}; choose another by --out"));
        let staging = Self { folder: folder.to_owned(), is_new: !folder.exists(), names: Vec::new(), interrupted };
        fs::create_dir_all(folder).map_err(failed)?;
        // Better now than after an hour.
        let probe = staging.temporary("probe");
        let _parts = parts();
        fs::write(&probe, []).and_then(|()| fs::remove_file(&probe)).map_err(failed)?;
        Ok(staging)
    }

    /// Writes a file under its temporary name.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), CliError> {
        self.check_interrupted()?;
        let temporary = self.temporary(name);
        self.names.push(name.to_owned());
        let mut parts = parts();
        parts.push(temporary.clone());
        fs::write(temporary, bytes).map_err(|error| self.failed(name, &error))?;
        drop(parts);
        self.check_interrupted()
    }

    /// Gives all files their names, in the order in which they were written.
    pub fn commit(mut self) -> Result<(), CliError> {
        self.check_interrupted()?;
        // Whoever stops the process from here on waits until all files are those of one bake.
        let _parts = parts();
        for name in std::mem::take(&mut self.names) {
            let renamed = fs::rename(self.temporary(&name), self.folder.join(&name));
            if let Err(error) = renamed {
                self.names.push(name.clone());
                return Err(self.failed(&name, &error));
            }
        }
        Ok(())
    }

    fn check_interrupted(&self) -> Result<(), CliError> {
        if self.interrupted.load(Ordering::Relaxed) { Err(CliError::Cancelled) } else { Ok(()) }
    }

    fn temporary(&self, name: &str) -> PathBuf {
        self.folder.join(format!(".{name}.{}.part", std::process::id()))
    }

    fn failed(&self, name: &str, error: &std::io::Error) -> CliError {
        CliError::new(format!("cannot write {}: {error}", self.folder.join(name).display()))
    }
}

impl Drop for Staging<'_> {
    /// Leaves nothing behind that was not committed.
    fn drop(&mut self) {
        let mut parts = parts();
        for name in &self.names {
            // It may not be there, where writing it failed.
            drop(fs::remove_file(self.temporary(name)));
        }
        parts.retain(|part| part.parent() != Some(self.folder.as_path()));
        if self.is_new {
            // Fails where anything lies in it, which is as it should be.
            drop(fs::remove_dir(&self.folder));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What lay in the folder stays, and nothing else does, whenever the interruption comes.
    #[test]
    fn an_interrupted_bake_leaves_the_last_good_one() {
        let folder = std::env::temp_dir().join(format!("radiosity-staging-{}", process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("scene.glb"), "good").unwrap();
        for before_writing in [true, false] {
            let interrupted = AtomicBool::new(before_writing);
            let mut staging = Staging::new(&folder, &interrupted).unwrap();
            assert_eq!(staging.write("scene.glb", b"unfinished").is_err(), before_writing);
            interrupted.store(true, Ordering::Relaxed);
            assert!(matches!(staging.commit(), Err(CliError::Cancelled)));
            assert_eq!(fs::read(folder.join("scene.glb")).unwrap(), b"good");
            assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        }
        fs::remove_dir_all(folder).unwrap();
    }
}

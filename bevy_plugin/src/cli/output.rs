//! Files that appear all together at the end or not at all.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::CliError;

/// Files on their way into a folder, under other names until all are whole.
pub(super) struct Staging {
    folder: PathBuf,
    is_new: bool,
    names: Vec<String>,
}

impl Staging {
    /// Makes the folder where there is none, and sees to it that files can be written there.
    pub fn new(folder: &Path) -> Result<Self, CliError> {
        let shown = folder.display();
        let failed =
            |error| CliError::new(format!("cannot write to the folder {shown}: {error}; choose another by --out"));
        let staging = Self { folder: folder.to_owned(), is_new: !folder.exists(), names: Vec::new() };
        fs::create_dir_all(folder).map_err(failed)?;
        // Better now than after an hour.
        let probe = staging.temporary("probe");
        fs::write(&probe, []).and_then(|()| fs::remove_file(&probe)).map_err(failed)?;
        Ok(staging)
    }

    /// Writes a file under its temporary name.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), CliError> {
        self.names.push(name.to_owned());
        fs::write(self.temporary(name), bytes).map_err(|error| self.failed(name, &error))
    }

    /// Gives all files their names, in the order in which they were written.
    pub fn commit(mut self) -> Result<(), CliError> {
        for name in std::mem::take(&mut self.names) {
            let renamed = fs::rename(self.temporary(&name), self.folder.join(&name));
            if let Err(error) = renamed {
                self.names.push(name.clone());
                return Err(self.failed(&name, &error));
            }
        }
        Ok(())
    }

    fn temporary(&self, name: &str) -> PathBuf {
        self.folder.join(format!(".{name}.{}.part", std::process::id()))
    }

    fn failed(&self, name: &str, error: &std::io::Error) -> CliError {
        CliError::new(format!("cannot write {}: {error}", self.folder.join(name).display()))
    }
}

impl Drop for Staging {
    /// Leaves nothing behind that was not committed.
    fn drop(&mut self) {
        for name in &self.names {
            // It may not be there, where writing it failed.
            drop(fs::remove_file(self.temporary(name)));
        }
        if self.is_new {
            // Fails where anything lies in it, which is as it should be.
            drop(fs::remove_dir(&self.folder));
        }
    }
}

//! Why nothing was baked.

use std::fmt;
use std::process::ExitCode;

use radiosity::bake::BakeError;

/// Why nothing was baked. Its text says what happened and what to do.
#[derive(Debug)]
pub enum CliError {
    /// The arguments make no sense, or ask for help.
    Usage(clap::Error),
    /// It failed.
    Failed(String),
    /// The user stopped it.
    Cancelled,
}

impl CliError {
    pub(super) fn new(text: impl Into<String>) -> Self {
        Self::Failed(text.into())
    }

    /// What the process ends with: 0 after help, 1, 2 or 130.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(error) => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2)),
            Self::Failed(_) => ExitCode::from(1),
            Self::Cancelled => ExitCode::from(130),
        }
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(error) => write!(f, "{error}"),
            Self::Failed(text) => write!(f, "error: {text}"),
            Self::Cancelled => write!(f, "cancelled; nothing was written"),
        }
    }
}

impl std::error::Error for CliError {}

impl From<BakeError> for CliError {
    fn from(error: BakeError) -> Self {
        match error {
            BakeError::Cancelled => Self::Cancelled,
            BakeError::OutOfMemory { .. } => {
                Self::Failed(format!("{error} (--memory, --texels-per-meter or --quality draft)"))
            }
            BakeError::UnusableUv { .. } => Self::Failed(format!("{error} (--uv auto)")),
            _ => Self::Failed(error.to_string()),
        }
    }
}

//! What is wrong with an input, and where.

use std::fmt;

/// A mistake in a line of the input, or something there that the user should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Flaw {
    /// Counted from 1.
    pub line: usize,
    /// What is wrong, and what to do about it.
    pub what: String,
}

impl Flaw {
    pub fn new(line: usize, what: impl Into<String>) -> Self {
        Self { line, what: what.into() }
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.line, self.what)
    }
}

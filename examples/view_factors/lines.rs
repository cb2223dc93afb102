//! The input as lines of words: comments and separators are gone, numbers are checked.

use crate::flaw::Flaw;

/// A line that says something.
pub struct Line<'a> {
    /// Counted from 1.
    pub number: usize,
    /// What stands between blanks, commas and tabs; never empty.
    pub words: Vec<&'a str>,
    /// All of it, a comment too.
    pub text: &'a str,
}

impl<'a> Line<'a> {
    /// The letter that says which kind of entry this is.
    pub fn letter(&self) -> char {
        self.words[0].chars().next().unwrap_or('!').to_ascii_uppercase()
    }

    /// What follows the first word, as it was typed.
    pub fn rest(&self) -> &'a str {
        self.text.trim_start().split_once(is_blank).map_or("", |(_, rest)| rest.trim())
    }

    /// The words after the letter. `entry` is how such a line looks.
    pub fn fields(&self, entry: &'static str) -> Fields<'a> {
        Fields::of(self.number, entry, self.words[1..].to_vec())
    }
}

/// The lines that are neither empty nor a comment.
pub fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    text.trim_start_matches('\u{feff}').lines().enumerate().filter_map(|(index, text)| {
        let told = text.split('!').next().unwrap_or_default();
        let words: Vec<&str> = told.split(is_blank).filter(|word| !word.is_empty()).collect();
        let is_comment = words.first().is_none_or(|word| word.starts_with('/'));
        (!is_comment).then_some(Line { number: index + 1, words, text })
    })
}

fn is_blank(c: char) -> bool {
    matches!(c, ' ' | ',' | '\t' | '\r' | '\0')
}

/// The words of an entry, taken one after the other.
pub struct Fields<'a> {
    /// Where the last word stands.
    pub line: usize,
    entry: &'static str,
    words: Vec<&'a str>,
    next: usize,
}

impl<'a> Fields<'a> {
    /// How many words are left.
    pub fn left(&self) -> usize {
        self.words.len() - self.next
    }

    /// Words that stand in some line.
    pub fn of(line: usize, entry: &'static str, words: Vec<&'a str>) -> Self {
        Self { line, entry, words, next: 0 }
    }

    /// The entry goes on in another line.
    pub fn extend(&mut self, line: &Line<'a>) {
        self.line = line.number;
        self.words.extend(&line.words);
    }

    pub fn word(&mut self, name: &str) -> Result<&'a str, Flaw> {
        let missing = || self.flaw(format!("the entry ends before its {name}"));
        let word = self.words.get(self.next).copied().ok_or_else(missing)?;
        self.next += 1;
        Ok(word)
    }

    /// A whole number, 0 or larger.
    pub fn index(&mut self, name: &str) -> Result<usize, Flaw> {
        let word = self.word(name)?;
        word.parse().map_err(|_| self.flaw(format!("the {name} is `{word}`, not a whole number")))
    }

    /// A finite number.
    pub fn real(&mut self, name: &str) -> Result<f64, Flaw> {
        let word = self.word(name)?;
        let finite = word.parse().ok().filter(|number: &f64| number.is_finite());
        finite.ok_or_else(|| self.flaw(format!("the {name} is `{word}`, not a finite number")))
    }

    /// The number of an entry, which counts up from 1.
    pub fn number(&mut self, name: &str, due: usize) -> Result<usize, Flaw> {
        let number = self.index(&format!("number of the {name}"))?;
        let flaw = || {
            let what = format!("{name} {number} stands where {name} {due} is due");
            Flaw::new(self.line, format!("{what}; number them 1, 2, 3 ... in the order of the file"))
        };
        (number == due).then_some(number).ok_or_else(flaw)
    }

    fn flaw(&self, what: String) -> Flaw {
        Flaw::new(self.line, format!("{what}; write `{}`", self.entry))
    }
}

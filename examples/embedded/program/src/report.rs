//! Lines of text from words and whole numbers: the formatting of `core` would be a third of the program, and can panic.

use crate::Board;
use crate::checksum::Checksum;

/// Prints what was found, and counts instructions.
pub struct Report<'a, B>(&'a mut B);

impl<'a, B: Board> Report<'a, B> {
    /// On a board.
    pub fn new(board: &'a mut B) -> Self {
        Self(board)
    }

    /// How many instructions a piece of work takes.
    pub fn measure(&mut self, work: impl FnOnce()) -> u32 {
        let start = self.0.instructions();
        work();
        self.0.instructions().saturating_sub(start) as u32
    }

    /// `what: number`
    pub fn count(&mut self, what: &str, number: u32) {
        self.text(what);
        self.text(": ");
        self.whole(number);
        self.text("\n");
    }

    /// `what: a b c unit`, rounded to whole numbers.
    pub fn numbers(&mut self, what: &str, unit: &str, numbers: [f32; 3]) {
        self.text(what);
        self.text(": ");
        for number in numbers {
            self.whole((number + 0.5) as u32);
            self.text(" ");
        }
        self.text(unit);
        self.text("\n");
    }

    /// `checksum of what: 0123abcd`
    pub fn checksum(&mut self, what: &str, Checksum(sum): Checksum) {
        self.text("checksum of ");
        self.text(what);
        self.text(": ");
        (0..8).rev().for_each(|digit| self.digit(sum >> (4 * digit) & 0xf));
        self.text("\n");
    }

    /// Whether all is as expected.
    pub fn verdict(&mut self, is_expected: bool) {
        self.text(if is_expected { "all as on the host\n" } else { "NOT as on the host\n" });
    }

    /// A piece of text.
    pub fn text(&mut self, text: &str) {
        self.0.write(text);
    }

    fn whole(&mut self, number: u32) {
        if number >= 10 {
            self.whole(number / 10);
        }
        self.digit(number % 10);
    }

    fn digit(&mut self, digit: u32) {
        const DIGITS: [&str; 16] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "a", "b", "c", "d", "e", "f"];
        self.text(DIGITS.get(digit as usize).copied().unwrap_or("?"));
    }
}

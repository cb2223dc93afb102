//! The command line.

use std::path::PathBuf;

use crate::method::Method;

pub const USAGE: &str = "usage: view_factors FILE.vs3 [--method M] [--accuracy E]

  FILE.vs3        surfaces in the input format of View3D
  --method M      auto (default), contour, double-integral, clipping, rays, hemicube or nusselt-rays
  --accuracy E    absolute error to aim for in each view factor; default: 1e-6, or `eps` of the file if that is less

Rays and hemicubes check the others; they stop at errors of 1e-3 to 1e-5. Estimated errors are printed for each row.";

/// What the user asks for.
#[derive(Debug)]
pub struct Args {
    pub file: PathBuf,
    pub method: Method,
    pub accuracy: Option<f64>,
}

/// Reads the words that follow the name of the program.
pub fn parse(words: impl Iterator<Item = String>) -> Result<Args, String> {
    let (mut file, mut method, mut accuracy) = (None, Method::Auto, None);
    let mut words = words;
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} needs a value"));
        match word.as_str() {
            "--method" => method = Method::named(&value()?)?,
            "--accuracy" => accuracy = Some(positive(&value()?)?),
            other if other.starts_with('-') => return Err(format!("{other} is unknown")),
            other if file.is_none() => file = Some(PathBuf::from(other)),
            other => return Err(format!("one file is read, not also {other}")),
        }
    }
    Ok(Args { file: file.ok_or("no file is given")?, method, accuracy })
}

fn positive(word: &str) -> Result<f64, String> {
    let accuracy = word.parse().ok().filter(|&number: &f64| number > 0.0 && number < 1.0);
    accuracy.ok_or(format!("the accuracy is {word}; give a number between 0 and 1, such as 1e-6"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Args, String> {
        parse(line.split_whitespace().map(String::from))
    }

    #[test]
    fn options_stand_anywhere() {
        let args = parsed("--method rays room.vs3 --accuracy 1e-3").unwrap();
        assert_eq!((args.file.to_str(), args.method, args.accuracy), (Some("room.vs3"), Method::Rays, Some(1e-3)));
    }

    #[test]
    fn wrong_words_are_told() {
        for (line, what) in [
            ("", "no file"),
            ("a b", "not also b"),
            ("a --method magic", "there are auto, contour"),
            ("a --accuracy", "needs a value"),
            ("a --accuracy 0", "between 0 and 1"),
            ("a --speed 9", "--speed is unknown"),
        ] {
            assert!(parsed(line).unwrap_err().contains(what), "{line}");
        }
    }
}

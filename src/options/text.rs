//! Texts about options, for the programs' help and the documents.

use super::table::{Bounds, Kind, Row, Value};
use super::{Choices, Criterion, Options};

impl Row {
    /// Returns the sentences that explain the option, with `name` for each name of an option.
    pub fn help(&self, name: impl Fn(&Row) -> String) -> String {
        with_names(self.help, name)
    }

    /// Returns the default of an option that is no number by dimension.
    pub fn default_text(&self) -> String {
        match self.get(&Options::default()) {
            Value::Number(default) => default.to_string(),
            Value::Whole(default) => default.to_string(),
            Value::Switch(default) => if default { "on" } else { "off" }.to_owned(),
            default @ Value::Word(_) => {
                self.word(default).map_or_else(String::new, |word| word.argument.to_owned())
            }
        }
    }

    /// Returns the bounds and the defaults of a number; nothing for other options.
    pub fn bounds_text(&self) -> String {
        let Kind::Number { ranges, .. } = self.kind else { return String::new() };
        let texts = ranges.iter().map(Bounds::text);
        let text = match ranges {
            [_] => texts.collect(),
            _ => {
                let named = texts.zip(Criterion::WORDS);
                let named = named.map(|(text, word)| format!("{}: {text}", word.argument));
                named.collect::<Vec<_>>().join("; ")
            }
        };
        let is_constant = |range: &Bounds| is_constant(range.default) && is_constant(range.lowest);
        match ranges.iter().all(is_constant) {
            true => text,
            false => text + " in 2D, 3D, 4D and above",
        }
    }
}

impl Bounds {
    /// Returns the default, or those of 2D, 3D, 4D and above; "none" if there is none.
    pub fn default_text(&self) -> String {
        match self.default {
            [0.0, ..] => "none".to_owned(),
            default => list(default),
        }
    }

    /// Returns the range, with the smallest numbers in 2D, 3D, 4D and above where they differ.
    pub fn range_text(&self) -> String {
        match (list(self.lowest), self.highest) {
            (lowest, f64::INFINITY) => format!("above {lowest}"),
            (lowest, highest) => format!("{lowest} to {highest}"),
        }
    }

    fn text(&self) -> String {
        let from = if self.highest.is_finite() { "from " } else { "" };
        let range = format!("{from}{}", self.range_text());
        match self.default {
            [0.0, ..] => range,
            _ => format!("{range}, by default {}", self.default_text()),
        }
    }
}

/// Returns `text` with `name` for each name of an option, which stand between backticks.
pub fn with_names(text: &str, name: impl Fn(&Row) -> String) -> String {
    let parts = text.split('`').enumerate();
    let named = |(at, part): (usize, &str)| match Row::named(part) {
        Some(row) if at % 2 == 1 => name(row),
        _ => part.to_owned(),
    };
    parts.map(named).collect()
}

/// Returns the numbers by dimension, or the only one.
fn list(numbers: [f64; 4]) -> String {
    match is_constant(numbers) {
        true => numbers[0].to_string(),
        false => numbers.map(|number| number.to_string()).join(", "),
    }
}

fn is_constant(numbers: [f64; 4]) -> bool {
    numbers.iter().all(|number| *number == numbers[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::TABLE;

    #[test]
    fn bounds_are_told_by_criterion_and_dimension() {
        let text = |name| Row::named(name).unwrap().bounds_text();
        assert_eq!(text("gamma"), "from 0.01 to 0.25, by default 0.1");
        assert_eq!(text("min_angle"), "from 0.6 to 33.7");
        assert_eq!(text("max_edge"), "above 0");
        let delta = "from 0.1 to 1, by default 0.8, 1, 1, 1 in 2D, 3D, 4D and above";
        assert_eq!(text("delta"), delta);
        assert!(
            text("quality_bound").starts_with("aspect: from 2.2, 2.5, 3.5, 4.5 to 100, by default")
        );
    }

    /// A name that no option has would stand between backticks in no caller's words.
    #[test]
    fn texts_name_options_alone() {
        for row in TABLE {
            let mut helps = vec![row.help];
            if let Kind::Words(words) = row.kind {
                helps.extend(words.iter().map(|word| word.help));
            }
            for help in helps {
                let names = help.split('`').skip(1).step_by(2);
                names.for_each(|name| assert!(Row::named(name).is_some(), "{name} in {help}"));
            }
            assert!(row.help.ends_with('.'), "{}", row.name);
        }
    }

    #[test]
    fn values_reach_their_fields_and_come_back() {
        for row in TABLE {
            let value = match row.kind {
                Kind::Number { .. } => Value::Number(1.25),
                Kind::Whole(_) => Value::Whole(7),
                Kind::Switch => Value::Switch(true),
                Kind::Words(words) => Value::Word(words.len() - 1),
            };
            let mut options = Options::default();
            row.set(&mut options, value);
            assert_eq!(row.get(&options), value, "{}", row.name);
            let changed =
                TABLE.iter().filter(|other| other.get(&options) != other.get(&Options::default()));
            assert_eq!(changed.map(|other| other.name).collect::<Vec<_>>(), [row.name]);
        }
    }
}

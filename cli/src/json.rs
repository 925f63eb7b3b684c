//! JSON objects, written by hand: names and texts escaped, numbers that read back as the same
//! doubles. JSON has no infinity: it becomes the text "inf" (-inf, nan), what was not measured
//! null.

use std::fmt::Write;

/// An object in the making, its members one per line.
pub struct Object {
    text: String,
    depth: usize,
}

impl Object {
    pub fn new() -> Self {
        Self { text: String::new(), depth: 1 }
    }

    pub fn text(&mut self, name: &str, value: &str) {
        let value = quoted(value);
        self.member(name, &value);
    }

    pub fn count(&mut self, name: &str, value: u64) {
        self.member(name, &value.to_string());
    }

    pub fn number(&mut self, name: &str, value: f64) {
        self.member(name, &number(value));
    }

    pub fn truth(&mut self, name: &str, value: bool) {
        self.member(name, if value { "true" } else { "false" });
    }

    pub fn null(&mut self, name: &str) {
        self.member(name, "null");
    }

    pub fn counts(&mut self, name: &str, values: &[u64]) {
        self.list(name, values.iter().map(u64::to_string));
    }

    pub fn numbers(&mut self, name: &str, values: &[f64]) {
        self.list(name, values.iter().map(|&value| number(value)));
    }

    fn list(&mut self, name: &str, values: impl Iterator<Item = String>) {
        let values: Vec<String> = values.collect();
        self.member(name, &format!("[{}]", values.join(", ")));
    }

    /// A member that is an object of its own, with the members that `fill` gives it.
    pub fn object(&mut self, name: &str, fill: impl FnOnce(&mut Self)) {
        let mut inner = Self { text: String::new(), depth: self.depth + 1 };
        fill(&mut inner);
        self.member(name, &inner.finished());
    }

    pub fn finished(self) -> String {
        format!("{{{}\n{}}}", self.text, "  ".repeat(self.depth - 1))
    }

    fn member(&mut self, name: &str, value: &str) {
        let comma = if self.text.is_empty() { "" } else { "," };
        let indent = "  ".repeat(self.depth);
        let _ = write!(self.text, "{comma}\n{indent}{}: {value}", quoted(name));
    }
}

/// The shortest decimal that reads back as the same double.
fn number(value: f64) -> String {
    if value.is_finite() {
        // Debug, unlike Display, has exponents: 1e300 and not 301 digits.
        format!("{value:?}")
    } else {
        quoted(&value.to_string().to_lowercase())
    }
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            control if control < ' ' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(control));
            }
            other => quoted.push(other),
        }
    }
    quoted.push('"');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn any_text_and_number_reads_back() {
        let text = "quote \" backslash \\ line\nbell \u{7} nul \0 umlaut ä smile \u{1f600}";
        let numbers = [0.0, -0.0, 1.5, 1e300, -2.5e-308, f64::MAX, f64::from_bits(1), 1.0 / 3.0];
        let mut object = Object::new();
        object.text(text, text);
        object.count("most", u64::MAX);
        object.null("nothing");
        object.object("inside", |inside| {
            inside.object("empty", |_| {});
            inside.truth("yes", true);
            inside.truth("no", false);
        });
        for (i, &value) in numbers.iter().enumerate() {
            object.number(&i.to_string(), value);
        }
        object.counts("counts", &[0, u64::MAX]);
        object.numbers("list", &[0.5, f64::INFINITY]);
        object.numbers("empty list", &[]);
        object.number("large", f64::INFINITY);
        object.number("small", f64::NEG_INFINITY);
        object.number("none", f64::NAN);
        let read: Value = serde_json::from_str(&object.finished()).expect("it is JSON");
        assert_eq!(read[text], text);
        assert_eq!(read["most"], u64::MAX);
        assert!(read["nothing"].is_null());
        assert_eq!(read["inside"], json!({ "empty": {}, "yes": true, "no": false }));
        assert_eq!(read["counts"], json!([0, u64::MAX]));
        assert_eq!(read["list"], json!([0.5, "inf"]));
        assert_eq!(read["empty list"], json!([]));
        for (i, &value) in numbers.iter().enumerate() {
            let back = read[i.to_string()].as_f64().expect("a number");
            assert_eq!(back.to_bits(), value.to_bits(), "{value:e}");
        }
        assert_eq!([&read["large"], &read["small"], &read["none"]], ["inf", "-inf", "nan"]);
        assert_eq!(read.as_object().expect("an object").len(), 7 + numbers.len() + 3);
    }
}

//! Rows of text, written as CSV [RFC 4180] and as Markdown.

#[derive(Clone, Debug)]
pub struct Table {
    /// The CSV file's name without its extension.
    pub name: String,
    columns: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(name: &str, columns: &[&'static str]) -> Self {
        Self { name: name.to_string(), columns: columns.to_vec(), rows: Vec::new() }
    }

    pub fn add(&mut self, row: Vec<String>) {
        assert_eq!(row.len(), self.columns.len(), "table {}: {row:?}", self.name);
        self.rows.push(row);
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn csv(&self) -> String {
        let header: Vec<String> = self.columns.iter().map(|c| c.to_string()).collect();
        std::iter::once(&header).chain(&self.rows).map(|row| csv_line(row)).collect()
    }

    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | ").replace('\n', " "));
        let header: Vec<String> = self.columns.iter().map(|c| c.to_string()).collect();
        let rule = format!("|{}\n", "---|".repeat(self.columns.len()));
        line(&header) + &rule + &self.rows.iter().map(|row| line(row)).collect::<String>()
    }
}

/// Content of a table's file, to make a report again without a run.
#[derive(Debug)]
pub struct Rows {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// A row with the names of its cells.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    columns: &'a [String],
    cells: &'a [String],
}

impl Rows {
    /// Nothing if it is no table as [`Table::csv`] writes them; no cell of ours holds a line's end.
    pub fn parse(csv: &str) -> Option<Self> {
        let mut lines = csv.lines().map(cells);
        let columns = lines.next()?;
        let rows: Vec<Vec<String>> = lines.collect();
        rows.iter().all(|row| row.len() == columns.len()).then_some(Self { columns, rows })
    }

    pub fn iter(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row { columns: &self.columns, cells })
    }
}

impl<'a> Row<'a> {
    /// The cell in `column`; "-" in a table of a version without that column.
    pub fn word(&self, column: &str) -> &'a str {
        let at = self.columns.iter().position(|name| name == column);
        at.map_or("-", |at| &self.cells[at])
    }

    /// NaN for a cell without a number.
    pub fn number(&self, column: &str) -> f64 {
        self.word(column).parse().unwrap_or(f64::NAN)
    }

    /// Zero for a cell without a count.
    pub fn count(&self, column: &str) -> usize {
        self.word(column).parse().unwrap_or(0)
    }
}

/// The cells of a line, without the quotes that [`quoted`] puts round some.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let cell = cells.last_mut().expect("one from the start");
        match letter {
            '"' if is_quoted && letters.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cell.push(letter),
        }
    }
    cells
}

fn csv_line(row: &[String]) -> String {
    let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
    cells.join(",") + "\n"
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_string()
    }
}

/// [`number`], or "-" for NaN, which stands for what was not measured.
pub fn number_or_dash(x: f64) -> String {
    if x.is_nan() { "-".to_string() } else { number(x) }
}

/// Four significant digits, without an exponent where six places do.
pub fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let magnitude = x.abs().log10().floor() as i32;
    match magnitude {
        -4..=3 => format!("{x:.*}", (3 - magnitude).clamp(0, 7) as usize),
        4..=9 => format!("{x:.0}"),
        _ => format!("{x:.3e}"),
    }
}

/// A row from anything that can be shown.
#[macro_export]
macro_rules! row {
    ($($cell:expr),* $(,)?) => { vec![$($cell.to_string()),*] };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_quotes_what_it_must() {
        let mut table = Table::new("t", &["a", "b"]);
        table.add(row!["plain", 1]);
        table.add(row!["x, \"y\"", "two\nlines"]);
        assert_eq!(table.csv(), "a,b\nplain,1\n\"x, \"\"y\"\"\",\"two\nlines\"\n");
        assert_eq!(table.len(), 2);
    }

    #[test]
    fn what_is_written_is_read() {
        let mut table = Table::new("t", &["a, b", "n"]);
        table.add(row!["x, \"y\"", 1.5]);
        table.add(row!["-", "-"]);
        let rows = Rows::parse(&table.csv()).unwrap();
        let read: Vec<Row> = rows.iter().collect();
        assert_eq!((read[0].word("a, b"), read[0].number("n")), ("x, \"y\"", 1.5));
        assert!(read[1].number("n").is_nan() && read[0].word("other") == "-");
        assert!(Rows::parse("a,b\n1\n").is_none() && Rows::parse("").is_none());
    }

    #[test]
    fn markdown_has_a_rule_below_its_header() {
        let mut table = Table::new("t", &["a", "b"]);
        table.add(row![1, 2]);
        assert_eq!(table.markdown(), "| a | b |\n|---|---|\n| 1 | 2 |\n");
    }

    #[test]
    #[should_panic(expected = "table t")]
    fn rows_have_the_header_s_length() {
        Table::new("t", &["a", "b"]).add(row![1]);
    }

    #[test]
    fn numbers_have_four_digits() {
        let shown = [0.0, 1.0, 12.3456, 1234.56, 123456.7, 0.00123456, 1e-7, 2.5e12].map(number);
        let expected =
            ["0", "1.000", "12.35", "1235", "123457", "0.001235", "1.000e-7", "2.500e12"];
        assert_eq!(shown, expected);
    }
}

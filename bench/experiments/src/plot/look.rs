//! What a tool's curves look like, in every plot, and what stands where a tool has no figure.

/// Who made the figures of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    Netmesh,
    Svr,
    Cgal,
    Triangle,
    TetGen,
}

impl Tool {
    /// Told apart by the colour-blind as well [Okabe and Ito, 2008]. NETMESH has shades of one
    /// colour, for plots in which several of its curves are compared.
    pub fn color(self, variant: usize) -> &'static str {
        match self {
            Tool::Netmesh => ["#0072b2", "#56b4e9", "#003f66", "#7aa6c2"][variant % 4],
            Tool::Svr => "#d55e00",
            Tool::Cgal => "#009e73",
            Tool::Triangle => "#cc79a7",
            Tool::TetGen => "#8a6d00",
        }
    }

    /// Which of the markers the tool's first curve has.
    pub fn marker(self) -> usize {
        self as usize
    }
}

/// Why a tool has no figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    Crashed,
    TooLong,
    Wrong,
}

impl Missing {
    pub const ALL: [Missing; 3] = [Missing::Crashed, Missing::TooLong, Missing::Wrong];

    /// The reason that a cell of a table gives; none where the tool was not there.
    pub fn of(note: &str) -> Option<Self> {
        match note {
            "crashed" | "failed" => Some(Missing::Crashed),
            "timeout" | "too large" | "not tried" => Some(Missing::TooLong),
            _ if note.starts_with("inputs merged") || note.starts_with("bound missed") => {
                Some(Missing::Wrong)
            }
            _ => None,
        }
    }

    /// For the legend.
    pub fn words(self) -> &'static str {
        match self {
            Missing::Crashed => "crashed or failed",
            Missing::TooLong => "took too long or grew too large, or was not tried after that",
            Missing::Wrong => "lost inputs or missed its bound",
        }
    }

    /// A cross, a bar or a ring about (x, y), to be stroked.
    pub fn mark(self, x: f64, y: f64) -> String {
        match self {
            Missing::Crashed => {
                format!("M{:.1} {:.1}l6 6M{:.1} {:.1}l6 -6", x - 3.0, y - 3.0, x - 3.0, y + 3.0)
            }
            Missing::TooLong => format!("M{:.1} {y:.1}h7", x - 3.5),
            Missing::Wrong => {
                format!("M{:.1} {y:.1}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z", x - 3.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_note_of_a_table_has_its_reason() {
        let reasons = [
            ("crashed", Some(Missing::Crashed)),
            ("failed", Some(Missing::Crashed)),
            ("timeout", Some(Missing::TooLong)),
            ("too large", Some(Missing::TooLong)),
            ("not tried", Some(Missing::TooLong)),
            ("inputs merged: 3", Some(Missing::Wrong)),
            ("bound missed: 1.2e10", Some(Missing::Wrong)),
            ("-", None),
            ("4.361", None),
        ];
        for (note, reason) in reasons {
            assert_eq!(Missing::of(note), reason, "{note}");
        }
    }

    #[test]
    fn no_two_tools_share_a_color() {
        let tools = [Tool::Netmesh, Tool::Svr, Tool::Cgal, Tool::Triangle, Tool::TetGen];
        let mut colors: Vec<_> = tools.iter().map(|tool| tool.color(0)).collect();
        colors.extend((1..4).map(|variant| Tool::Netmesh.color(variant)));
        let all = colors.len();
        colors.sort_unstable();
        colors.dedup();
        assert_eq!(colors.len(), all);
    }
}

//! Names in messages: options, their values, and other things that a caller has given.

pub use crate::options::Choice;
use crate::options::{Chosen, Options, Row, each_option};
use std::fmt::{self, Display, Formatter};

macro_rules! declare_names {
    ($($name:ident $field:ident: $type:ty { $($row:tt)* })*) => {
        /// Thing that the caller has given. C, the command line and Python have words of their own
        /// for it; those of Rust are its [`Display`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Name {
            /// Option with the value that the caller has chosen.
            Chosen(Choice),
            $(#[doc = concat!("The option `", stringify!($field), "`.")] $name,)*
            /// Function that tells sizes.
            Size,
            /// Sizes given by values at the inputs.
            Sizes,
            /// Sizes given by values at the vertices of a background.
            Background,
            /// Size at an input, by the number of the input.
            SizeAt(usize),
            /// Size at a vertex of a background.
            BackgroundSizeAt(usize),
            /// Method by which a function goes on between vertices.
            Interpolation,
            /// Point of a region or hole, by its number among all regions.
            Seed(u32),
            /// Facet that is a polygon, by its number.
            Facet(usize),
            /// Triangle of a surface, by its number.
            Triangle(usize),
            /// Segment, by its number.
            Segment(usize),
            /// Input of a facet or segment that the message names, by its number.
            Input(usize),
            /// Columns that are coordinates.
            Columns,
            /// Columns that are attributes.
            Attributes,
            /// Domain of a selection.
            SelectedDomain,
        }

        impl Name {
            /// Names of all options, in the order of the table.
            pub(crate) const OPTIONS: &'static [Self] = &[$(Self::$name,)*];

            /// Returns the name of the option, as C, Rust and Python have it; `None` for what is no
            /// option, and for an option with a value.
            pub fn option(self) -> Option<&'static str> {
                match self {
                    $(Self::$name => Some(stringify!($field)),)*
                    _ => None,
                }
            }
        }
    };
}
each_option!(declare_names);

impl Name {
    /// Returns the name of a row's option, with its value among `options` where that has a word.
    ///
    /// # Panics
    /// If the row is none of the table's.
    pub fn of(row: &Row, options: &Options) -> Self {
        let is_of_row = |name: &&Self| name.option() == Some(row.name);
        let option = || *Self::OPTIONS.iter().find(is_of_row).expect("a row of the table");
        row.choice(options).map_or_else(option, Self::Chosen)
    }
}

impl From<Choice> for Name {
    fn from(choice: Choice) -> Self {
        Self::Chosen(choice)
    }
}

/// The words of Rust.
impl Display for Name {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Chosen(choice) => write!(f, "{choice}"),
            Self::Size => f.write_str("size"),
            Self::Sizes => f.write_str("Mesh::set_sizes"),
            Self::Background => f.write_str("Mesh::set_background"),
            Self::SizeAt(at) | Self::BackgroundSizeAt(at) => write!(f, "sizes[{at}]"),
            Self::Interpolation => f.write_str("method.interpolation"),
            Self::Seed(number) => write!(f, "regions[{number}].seed"),
            Self::Facet(at) => write!(f, "facets[{at}]"),
            Self::Triangle(at) => write!(f, "triangles[{at}]"),
            Self::Segment(at) => write!(f, "segments[{at}]"),
            Self::Input(at) => write!(f, "{at}"),
            Self::Columns => f.write_str("columns"),
            Self::Attributes => f.write_str("attributes"),
            Self::SelectedDomain => f.write_str("selection.domain"),
            _ => write!(f, "options.{}", self.option().unwrap_or_default()),
        }
    }
}

/// The words of Rust.
impl Display for Choice {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Chosen { option, kind, word } = self.chosen();
        write!(f, "options.{option} = {kind}::{}", word.value)
    }
}

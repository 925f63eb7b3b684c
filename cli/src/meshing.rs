//! Options of the library as arguments, made of its table of options. netmesh-mpi has this file,
//! too; each program tells under which heading it has an option, if at all.

use crate::arguments::heading;
use crate::whole::whole;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use netmesh::Options;
use netmesh::options::text::with_names;
use netmesh::options::{Kind, Row, TABLE, Value, Word};

/// Options of the library that the command line has.
#[derive(Clone, Debug)]
pub struct Meshing {
    pub options: Options,
}

impl clap::Args for Meshing {
    fn augment_args(command: Command) -> Command {
        command.args(TABLE.iter().filter_map(|row| Some(argument(row).help_heading(heading(row)?))))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl clap::FromArgMatches for Meshing {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut meshing = Self { options: Options::default() };
        meshing.update_from_arg_matches(matches)?;
        Ok(meshing)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for row in TABLE.iter().filter(|row| heading(row).is_some()) {
            if matches.value_source(row.name) == Some(ValueSource::CommandLine) {
                row.set(&mut self.options, value(row, matches));
            }
        }
        Ok(())
    }
}

/// Makes the argument of an option.
fn argument(row: &'static Row) -> Arg {
    let (name, value_name) = (row.argument(), row.name.to_uppercase());
    let help = row.help(with_dashes);
    let mut argument = Arg::new(row.name).long(name).value_name(value_name);
    let field = row.name.replace('_', "-");
    if field != row.argument() {
        argument = argument.visible_alias(field);
    }
    // What says the same is refused beside it.
    if row.name == "min_angle" {
        argument = argument.conflicts_with_all(["quality_bound", "criterion"]);
    }
    let help = help.trim_end_matches('.').to_owned();
    match row.kind {
        Kind::Number { unit, .. } => argument
            .value_name(unit)
            .value_parser(value_parser!(f64))
            .help(format!("{help} ({})", row.bounds_text())),
        Kind::Whole(largest) => {
            let argument = argument.value_name("N").help(help);
            let argument = argument.value_parser(move |text: &str| whole(text, largest));
            match row.name {
                // Zero is no number of vertices.
                "max_vertices" => argument,
                _ => argument.default_value(row.default_text()),
            }
        }
        Kind::Words(words) => argument
            .value_parser(PossibleValuesParser::new(words.iter().map(possible_value)))
            .default_value(row.default_text())
            .help(help),
        Kind::Switch => argument.action(ArgAction::SetTrue).help(help),
    }
    .allow_negative_numbers(true)
}

fn possible_value(word: &Word) -> PossibleValue {
    PossibleValue::new(word.argument).help(with_names(word.help, with_dashes))
}

fn with_dashes(row: &Row) -> String {
    format!("--{}", row.argument())
}

/// Returns the value that was given for an option.
fn value(row: &Row, matches: &ArgMatches) -> Value {
    let given = "clap has checked the value";
    match row.kind {
        Kind::Number { .. } => Value::Number(*matches.get_one(row.name).expect(given)),
        Kind::Whole(_) => Value::Whole(*matches.get_one(row.name).expect(given)),
        Kind::Words(words) => {
            let word: &String = matches.get_one(row.name).expect(given);
            let is_it = |known: &Word| known.argument == word;
            Value::Word(words.iter().position(is_it).expect(given))
        }
        Kind::Switch => Value::Switch(matches.get_flag(row.name)),
    }
}

//! Text that ends where memory runs out.

use std::fmt::{self, Write};

/// Formats a message as `format!` does; if memory runs out the message ends early, not the process.
macro_rules! message {
    ($($argument:tt)*) => {
        $crate::error::written(format_args!($($argument)*))
    };
}
pub(crate) use message;

/// Returns the text of [`message!`], which calls it.
pub(crate) fn written(arguments: fmt::Arguments<'_>) -> String {
    let mut text = Text(String::new());
    // Cut off where memory ran out; the error's kind says the rest.
    let _ = text.write_fmt(arguments);
    text.0
}

/// String that refuses to grow where `String` would end the process.
pub(super) struct Text(pub String);

impl Write for Text {
    fn write_str(&mut self, piece: &str) -> fmt::Result {
        self.0.try_reserve(piece.len()).map_err(|_| fmt::Error)?;
        self.0.push_str(piece);
        Ok(())
    }
}

//! Whole numbers on the command line.

/// Returns the whole number that a text is, up to `largest`, or the rule for clap to say.
pub fn whole(text: &str, largest: u64) -> Result<u64, String> {
    let number = text.parse::<u64>().ok().filter(|number| *number <= largest);
    number.ok_or_else(|| format!("it must be a whole number from 0 to {largest}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_gets_the_range() {
        let most = u64::from(u32::MAX);
        assert_eq!((whole("7", u64::MAX), whole("4294967295", most)), (Ok(7), Ok(most)));
        assert_eq!(whole("18446744073709551615", u64::MAX), Ok(u64::MAX));
        for text in ["-5", "1.5", "x", "", "4294967296"] {
            let rule = "it must be a whole number from 0 to 4294967295";
            assert_eq!(whole(text, most), Err(rule.to_owned()), "{text}");
        }
        let rule = "it must be a whole number from 0 to 18446744073709551615";
        assert_eq!(whole("18446744073709551616", u64::MAX), Err(rule.to_owned()));
    }
}

//! Whole numbers on the command line.

/// Returns the whole number that a text is, or the rule for clap to say.
pub fn whole<T: TryFrom<u64>>(text: &str) -> Result<T, String> {
    let number = text.parse::<u64>().ok().and_then(|number| T::try_from(number).ok());
    let largest = if size_of::<T>() < size_of::<u64>() { u64::from(u32::MAX) } else { u64::MAX };
    number.ok_or_else(|| format!("it must be a whole number from 0 to {largest}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_gets_the_range() {
        assert_eq!((whole::<u64>("7"), whole::<u32>("4294967295")), (Ok(7), Ok(u32::MAX)));
        assert_eq!(whole::<u64>("18446744073709551615"), Ok(u64::MAX));
        for text in ["-5", "1.5", "x", "", "4294967296"] {
            let rule = "it must be a whole number from 0 to 4294967295";
            assert_eq!(whole::<u32>(text), Err(rule.to_owned()), "{text}");
        }
        let rule = "it must be a whole number from 0 to 18446744073709551615";
        assert_eq!(whole::<u64>("18446744073709551616"), Err(rule.to_owned()));
    }
}

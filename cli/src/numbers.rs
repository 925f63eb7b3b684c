//! Numbers as a person reads them.

/// Writes a number with spaces between groups of three digits: 1234567 -> "1 234 567".
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Writes a number with the noun that goes with it: "1 simplex", "2 simplices".
pub fn counted(number: u64, one: &str, many: &str) -> String {
    format!("{} {}", grouped(number), if number == 1 { one } else { many })
}

/// Writes numbers with their nouns, as [`counted`] does, but those that are 0.
pub fn counted_all<const N: usize>(numbers: [(u64, &str, &str); N]) -> Vec<String> {
    let numbers = numbers.into_iter().filter(|(number, _, _)| *number > 0);
    numbers.map(|(number, one, many)| counted(number, one, many)).collect()
}

/// Writes a value with four significant digits; scientific where the plain form would be long.
pub fn measure(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if !(1e-3..1e6).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let decimals = (3 - magnitude.log10().floor() as i32).clamp(0, 6) as usize;
    format!("{value:.decimals$}")
}

/// Writes a time in seconds with a unit that keeps the number readable: ms, s or min.
pub fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.1} ms", seconds * 1e3)
    } else if seconds < 120.0 {
        format!("{seconds:.2} s")
    } else {
        format!("{} min {:02.0} s", (seconds / 60.0).floor(), seconds % 60.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_three() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1000), "1 000");
        assert_eq!(grouped(1234567), "1 234 567");
    }

    #[test]
    fn one_and_many() {
        assert_eq!(counted(1, "simplex", "simplices"), "1 simplex");
        assert_eq!(counted(2000, "simplex", "simplices"), "2 000 simplices");
    }

    #[test]
    fn four_significant_digits() {
        assert_eq!(measure(0.0), "0");
        assert_eq!(measure(2.99951), "3.000");
        assert_eq!(measure(12.3456), "12.35");
        assert_eq!(measure(0.04321), "0.04321");
        assert_eq!(measure(1.7e18), "1.700e18");
        assert_eq!(measure(f64::INFINITY), "inf");
    }

    #[test]
    fn durations_have_a_unit() {
        assert_eq!(duration(0.0123), "12.3 ms");
        assert_eq!(duration(12.346), "12.35 s");
        assert_eq!(duration(125.0), "2 min 05 s");
    }
}

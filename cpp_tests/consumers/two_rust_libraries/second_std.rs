//! A library with the whole of Rust's standard library in it: threads, panics and who catches them.

fn panics(number: u32) -> u32 {
    std::panic::resume_unwind(Box::new(number))
}

/// Panics on this thread and on others, catches all and counts them: 3.
#[unsafe(no_mangle)]
pub extern "C" fn second_answer() -> u32 {
    let here = std::panic::catch_unwind(|| panics(1)).is_err();
    let others: Vec<_> = (2..4).map(|number| std::thread::spawn(move || panics(number))).collect();
    let elsewhere = others.into_iter().filter_map(|thread| thread.join().err()).count();
    u32::from(here) + elsewhere as u32
}

include("${CMAKE_CURRENT_LIST_DIR}/../common.cmake")

# Nothing of Rust's runtime can clash with anybody's: the archive's names are those of the ABI alone.
run("${nm}" --extern-only --defined-only --format=posix "${prefix}/${library_dir}/${static_name}")
string(REGEX MATCHALL "(^|\n)[^ \n]+ [A-Za-z] " names "${run_output}")
list(TRANSFORM names REPLACE "^\n|\n| [A-Za-z] $" "")
list(SORT names)
file(STRINGS "${source_dir}/cpp_tests/symbols.txt" listed)
require_equal("${static_name} defines" "${names}" "${listed}")

build_with_make(two_rust_libraries "RUSTC=${rustc}")
expect_the_mesh(two_rust_libraries std_first std_last bare_first bare_last)

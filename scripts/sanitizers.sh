# Sourced by test.sh: the tests of the C ABI under the address, undefined behaviour and thread
# sanitizers, each in a build directory of its own.

# build_and_test DIRECTORY
build_and_test() {
  local directory="$1"
  cmake --build "$directory" --parallel "$jobs"
  # The thread sanitizer's tables have fixed places, which much randomisation of addresses takes.
  local steady=()
  if setarch --addr-no-randomize true 2>/dev/null; then steady=(setarch --addr-no-randomize); fi
  "${steady[@]}" ctest --test-dir "$directory" --output-on-failure
  skips_of_ctest "$directory"
}

address_sanitizer_tests() {
  cmake --preset asan
  build_and_test target/cmake-address
}

# With the Rust code instrumented too, or the locks in it would be out of sight. Flags of the compiler
# that are not stable need RUSTC_BOOTSTRAP; the standard library stays as it is, but for what is
# generic or inline, such as its locks. The library compiles for longer than the tests run: it is less
# optimised, and for no more dimensions than these tests mesh in.
thread_sanitizer_tests() {
  local triple flags="-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer"
  local probe="$PWD/target/sanitizer/probe"
  triple="$(rustc -vV | sed -n 's/^host: //p')"
  mkdir -p "$probe"
  # Into a directory: as root, rustc would replace a device that is named as its output.
  # shellcheck disable=SC2086
  if ! RUSTC_BOOTSTRAP=1 rustc $flags --crate-type lib --crate-name probe --emit metadata \
    --out-dir "$probe" - </dev/null; then
    skipped "thread sanitizer" "this Rust compiler has none"
    return 0
  fi
  local environment="RUSTC_BOOTSTRAP=1;RUSTFLAGS=$flags --cfg=netmesh_few_dimensions"
  environment+=";CARGO_PROFILE_RELEASE_OPT_LEVEL=1"
  cmake -S . -B target/cmake-thread -DCMAKE_BUILD_TYPE=RelWithDebInfo -DNETMESH_BUILD_BENCHMARKS=OFF \
    -DNETMESH_BUILD_CLI=OFF -DNETMESH_SANITIZERS=thread -DNETMESH_INSTRUMENTED=ON \
    -DNETMESH_CARGO_TARGET="$triple" -DNETMESH_CARGO_ENVIRONMENT="$environment" \
    -DNETMESH_CARGO_TARGET_DIR="$PWD/target/sanitizer"
  build_and_test target/cmake-thread
}

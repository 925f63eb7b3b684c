#!/usr/bin/env bash
# Runs every test there is; installs what that needs on Debian. NETMESH_JOBS limits the processes.
set -euo pipefail
cd "$(dirname "$0")"
exec </dev/null

readonly jobs="${NETMESH_JOBS:-$(nproc)}"
readonly tools="$PWD/target/tools" venv="$PWD/target/venv"
# shellcheck source=scripts/common.sh
. scripts/common.sh
# shellcheck source=scripts/tools.sh
. scripts/tools.sh
# shellcheck source=scripts/sanitizers.sh
. scripts/sanitizers.sh

step "tools"
need_cargo
need_packages g++ cmake make pkg-config valgrind libcgal-dev libeigen3-dev libtet1.5-dev locales doxygen python3 python3-venv \
  libglu1-mesa libgl1 libxcursor1 libxft2 libxinerama1 libgomp1
need_rust_components
export PATH="$venv/bin:$tools/bin:$PATH" CARGO_BUILD_JOBS="$jobs"
need_cbindgen
need_readers

step "format"
cargo fmt --all --check

step "clippy"
cargo clippy --workspace --all-targets --locked -- -D warnings

step "Rust tests"
cargo test --workspace --locked --no-fail-fast

step "C++ harness: build"
cmake --preset release
cmake --build --preset release --parallel "$jobs"

step "C++ harness: CGAL, TetGen, valgrind, projects that use the package"
ctest --preset release --parallel "$jobs"

step "C ABI: address and undefined behaviour sanitizers"
address_sanitizer_tests

step "C ABI: thread sanitizer"
thread_sanitizer_tests

step "Miri"
miri="$(miri_toolchain)"
if [ -n "$miri" ]; then
  MIRIFLAGS=-Zmiri-disable-isolation cargo "+$miri" miri test --package netmesh --lib -- capi memory pair::
else
  echo "skipped: no nightly toolchain with the component miri"
fi

step "all tests passed"

#!/usr/bin/env bash
# Runs every test there is, or those of some lanes; installs what they need on Debian.
#
#   ./test.sh [--without TOOL]... [LANE...]
#
# Lanes: format clippy cpp rust mpi python sanitizers miri. Without a tool its tests are skipped; the tools that
# may be absent so are `readers` (the Python packages that read in tests what netmesh has written),
# `python` (those that the Python package is built and tested with), `mpi` and `miri`.
# NETMESH_WITHOUT="readers miri" says the same. NETMESH_JOBS limits the processes of a lane.
# Two lanes run at a time, and what a lane says is printed when it ends; the first that fails ends all.
# The end tells the seconds of every lane, by the clock and of processors, and what was skipped and why. On a
# machine that has other work to do only the latter tell how long the lanes take.
set -euo pipefail
cd "$(dirname "$0")"
exec </dev/null

# In the order in which they begin. Clippy and the Rust tests would wait for each other's lock.
readonly all_lanes=(format clippy cpp rust mpi python sanitizers miri)
readonly jobs="${NETMESH_JOBS:-$(nproc)}"
readonly tools="$PWD/target/tools" venv="$PWD/target/venv"
# shellcheck source=scripts/common.sh
. scripts/common.sh
# shellcheck source=scripts/lanes.sh
. scripts/lanes.sh
# shellcheck source=scripts/report.sh
. scripts/report.sh
# shellcheck source=scripts/tools.sh
. scripts/tools.sh
# shellcheck source=scripts/sanitizers.sh
. scripts/sanitizers.sh
# shellcheck source=scripts/python.sh
. scripts/python.sh
# shellcheck source=scripts/mpi.sh
. scripts/mpi.sh

usage() {
  fail "usage: ./test.sh [--without readers|python|mpi|miri]... [LANE...]; lanes: ${all_lanes[*]}"
}

lanes=() wanted=() without=" ${NETMESH_WITHOUT:-} "
while [ $# -gt 0 ]; do
  case "$1" in
    --without)
      [ $# -gt 1 ] || usage
      without+="$2 "
      shift
      ;;
    *)
      [[ " ${all_lanes[*]} " == *" $1 "* ]] || usage
      lanes+=("$1")
      ;;
  esac
  shift
done
for tool in $without; do
  [[ " readers python mpi miri " == *" $tool "* ]] || usage
done
[ ${#lanes[@]} -gt 0 ] || lanes=("${all_lanes[@]}")

tools_lane() {
  need_cargo
  need_linker
  if has_lane format || has_lane clippy || { has_lane python && ! is_without python; }; then need_rust_components; fi
  if has_lane cpp; then
    need_packages g++ cmake make pkg-config valgrind libcgal-dev libeigen3-dev libtet1.5-dev locales doxygen python3
  elif has_lane sanitizers; then
    need_packages g++ cmake make
  fi
  if has_lane rust; then need_packages g++ bsdutils python3; fi
  if has_lane mpi && ! is_without mpi; then
    need_packages g++ cmake make procps libopenmpi-dev openmpi-bin
    use_mpi
  fi
  if has_lane rust || { has_lane mpi && ! is_without mpi; }; then need_readers; fi
  if has_lane python && ! is_without python; then need_packages python3-venv libgl1; fi
}

format_lane() {
  cargo fmt --all --check
}

clippy_lane() {
  cargo clippy --workspace --all-targets --locked -- -D warnings
}

# Tests that cannot run say so on a line of their own: `skipped: REASON`.
rust_lane() {
  local log="$PWD/target/rust_tests.log"
  cargo test --workspace --exclude netmesh-mpi --locked --no-fail-fast -- --show-output | tee "$log"
  skips_of_cargo "$log"
}

# What there is on MPI has a lane of its own.
cpp_lane() {
  cmake --preset release -DNETMESH_BUILD_MPI=OFF
  cmake --build --preset release --parallel "$jobs"
  ctest --preset release --parallel "$jobs"
  skips_of_ctest target/cmake
}

sanitizers_lane() {
  address_sanitizer_tests
  thread_sanitizer_tests
}

miri_lane() {
  local toolchain
  toolchain="$(miri_toolchain)"
  if is_without miri; then
    skipped "miri" "--without miri"
  elif [ -z "$toolchain" ]; then
    skipped "miri" "there is no nightly toolchain with the component miri"
  else
    MIRIFLAGS=-Zmiri-disable-isolation cargo "+$toolchain" miri test --package netmesh --lib -- \
      capi memory pair::
  fi
}

# Nothing is edited between two builds here, and nobody looks at a test with a debugger. Without link
# time optimisation between its units the library compiles in 64 s of CPU time instead of 82, and the
# tests, which take less than compiling does, run a sixth longer.
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=0 CARGO_PROFILE_DEV_LTO=off
# The library that users build is one unit at the highest level, which takes three times as long to
# compile. The tests need neither; they need that assertions are off. Line tables stay: a test of the
# package sees that they are not installed.
export CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_OPT_LEVEL=2
export PATH="$venv/bin:$tools/bin:$PATH" CARGO_BUILD_JOBS="$jobs"

mkdir -p "$logs"
: >"$skips"
rm -f "$logs"/*.times
trap report EXIT
step "tools"
tools_lane
took tools $SECONDS
for lane in "${all_lanes[@]}"; do
  if has_lane "$lane"; then wanted+=("$lane"); else skipped "$lane" "other lanes were asked for"; fi
done
run_lanes "${wanted[@]}"
step "all tests passed"

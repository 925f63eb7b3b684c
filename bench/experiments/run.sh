#!/usr/bin/env bash
# Builds and runs the experiments: the paper's theorems as measured curves, beside SVR and other
# meshers. All of them are meant to take 20 minutes: the last full run took 16 with NETMESH_JOBS=4 on four
# cores, the one before 27 with 2, on a machine with other work to do.
#
#   bench/experiments/run.sh [--write] [--quick | --from-csv] [names...]
#
# --from-csv runs nothing: it makes verdicts and pictures again from the tables that are there.
# --write puts tables and pictures into docs/reports/ and the document into docs/reports/experiments.md;
# without it they are left under target/experiments. names: spread, growth, finishing, skew_lines,
# sizes, dimensions, cage_cells, slivers. NETMESH_BUILD is where CMake builds (target/cmake), NETMESH_JOBS how
# many runs go on at a time where nothing is timed (2).
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
readonly target="${CARGO_TARGET_DIR:-$root/target}"
readonly build="${NETMESH_BUILD:-$target/cmake}" jobs="${NETMESH_JOBS:-2}"
readonly work="$target/experiments" venv="$target/experiments/venv"
# shellcheck source=scripts/common.sh
. "$root/scripts/common.sh"

write=no
if [ "${1:-}" = --write ]; then
  write=yes
  shift
fi

# Triangle is not free software: its module stays in a virtual environment of its own.
has_triangle() {
  [ -x "$venv/bin/python" ] && "$venv/bin/python" -c 'import triangle' 2>/dev/null
}

install_package() {
  has python3 && python3 -m venv "$venv" &&
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
}

build_peers() {
  has cmake || return 1
  # Also where there is a build: a target that it does not know yet would not be found.
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DNETMESH_CARGO_TARGET_DIR="$target" || return 1
  cmake --build "$build" --target experiment_peers --parallel "$jobs"
}

need_cargo
cargo build --release --locked --manifest-path "$root/Cargo.toml" --package netmesh-experiments >&2

options=(--jobs "$jobs" --scratch "$work/scratch")
if [[ " $* " == *" --from-csv "* ]]; then
  : # which needs no other mesher
elif build_peers >&2; then
  options+=(--peers "$build/bench/experiments/peers/experiment_peers")
else
  echo "TetGen and CGAL are left out: their program cannot be built here" >&2
fi
if [[ " $* " == *" --from-csv "* ]]; then
  :
elif has_triangle || { install_package triangle && has_triangle; } >&2; then
  options+=(--triangle "$venv/bin/python" "$here/peers/refine_with_triangle.py")
else
  echo "Triangle is left out: no python3 that can have the PyPI module triangle" >&2
fi
if [ "$write" = yes ]; then
  output="$root/docs/reports" document="$root/docs/reports/experiments.md"
else
  output="$work/results" document="$work/results.md"
fi
"$target/release/experiments" "${options[@]}" --output "$output" --document "$document" "$@"

if "$venv/bin/python" -c 'import matplotlib' 2>/dev/null || install_package matplotlib; then
  "$venv/bin/python" "$root/bench/plots/draw.py" experiments "$output"
else
  echo "Pictures are left out: no python3 that can have Matplotlib" >&2
fi

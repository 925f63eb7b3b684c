#!/usr/bin/env bash
# Runs netmesh on the inputs that break other mesh generators; prints the table and ends with 1 if a
# case fails.
#
#   bench/breakers/run.sh [--write] [options of breakers, see main.cpp]
#
# --write puts the table into docs/reports/breakers.md. NETMESH_BUILD is where CMake builds (target/cmake),
# NETMESH_JOBS how many processes run at a time (2).
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
build="${NETMESH_BUILD:-$root/target/cmake}"
jobs="${NETMESH_JOBS:-2}"
document="$root/docs/reports/breakers.md"

write=no
if [ "${1:-}" = --write ]; then
  write=yes
  shift
fi

if [ ! -f "$build/CMakeCache.txt" ]; then
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release \
    -DNETMESH_CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$root/target}" >&2
fi
cmake --build "$build" --target breakers --parallel "$jobs" >&2

table="$(mktemp)"
trap 'rm -f "$table"' EXIT
result=0
"$build/bench/breakers/breakers" --found "$here/found" --jobs "$jobs" "$@" >"$table" || result=$?
cat "$table"
if [ "$write" = yes ]; then
  cat "$here/introduction.md" "$table" >"$document"
fi
exit "$result"

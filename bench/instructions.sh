#!/usr/bin/env bash
# Counts the instructions of whole runs under callgrind: a figure that another program on the machine
# does not disturb, so that a change of one percent shows. What the input costs to make and the
# process to start is in it.
#
#   bench/instructions.sh [--record "what changed"]
#
# --record appends the figures to the table at the end of docs/performance.md, under that label and the
# last commit that changed src (with a + where src differs from what is committed).
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/.." && pwd)"
readonly target="${CARGO_TARGET_DIR:-$root/target}" document="$root/docs/performance.md"
# shellcheck source=scripts/common.sh
. "$root/scripts/common.sh"

# Dimension, points, kind; the columns of the last table of docs/performance.md have the same order.
readonly cases=(
  "2 5000 uniform"
  "3 5000 uniform"
  "4 500 uniform"
  "3 5000 clusters"
  "3 5000 finished"
  "3 5000 delaunay"
)

label=
if [ $# -eq 2 ] && [ "$1" = --record ] && [ -n "$2" ]; then
  label="$2"
elif [ $# -ne 0 ]; then
  fail "usage: bench/instructions.sh [--record \"what changed\"]"
fi
case "$label" in
  *'|'* | *$'\n'*) fail "a label is one line without |: it is a cell of a table" ;;
esac

# count DIM N KIND: sets instructions and vertices. callgrind writes its total to the profile's
# last lines; the program writes the vertices.
count() {
  vertices="$(valgrind --quiet --tool=callgrind --callgrind-out-file="$profile" \
    "$target/release/one_run" "$@")"
  instructions="$(sed -n 's/^\(totals\|summary\): //p' "$profile" | tail -n 1)"
  [ -n "$instructions" ] || fail "callgrind counted nothing for: $*"
}

# The commit that the figures are of. Not HEAD: that may be one of the documents or of this script.
measured_commit() {
  local changes
  changes="$(git -C "$root" status --porcelain -- src)"
  printf '%s%s' "$(git -C "$root" log -1 --format=%h -- src)" "${changes:++}"
}

need_cargo
need_packages valgrind
cargo build --release --locked --manifest-path "$here/speed/Cargo.toml" --target-dir "$target" >&2
profile="$(mktemp)"
trap 'rm -f "$profile"' EXIT

row="| $label ($(measured_commit)) |"
printf '%-20s %12s %14s %24s\n' case vertices "10^6 instr." "10^3 instr. per vertex"
for entry in "${cases[@]}"; do
  read -r dim n kind <<<"$entry"
  count "$dim" "$n" "$kind"
  millions="$(awk -v i="$instructions" 'BEGIN { printf "%.1f", i / 1e6 }')"
  thousands="$(awk -v i="$instructions" -v v="$vertices" 'BEGIN { printf "%.2f", i / v / 1e3 }')"
  printf '%-20s %12s %14s %24s\n' "${dim}D $n $kind" "$vertices" "$millions" "$thousands"
  row+=" $millions ($thousands) |"
done

if [ -n "$label" ]; then
  printf '%s\n' "$row" >>"$document"
fi

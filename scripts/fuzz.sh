#!/usr/bin/env bash
# Runs each fuzz target for SECONDS of wall-clock time (default 1800), one after the other, or those
# that are named: scripts/fuzz.sh [SECONDS] [TARGET...]. Goes on after a finding; fails if there was
# one. What was found lies in fuzz/artifacts. Needs a nightly toolchain and cargo-fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds="${1:-1800}"
shift || true
targets=("$@")
[ "${#targets[@]}" -gt 0 ] || targets=(signs mesh slivers segments facets c_api readers poly features)

# Only the C API has unsafe code for the sanitizer to look at; the others are twice as fast without.
sanitizer() {
  if [ "$1" = c_api ]; then echo address; else echo none; fi
}

# Runs a target; its findings stay in fuzz/artifacts. Inputs that it invents go to fuzz/found, which
# is not checked in.
run_target() {
  local target="$1"
  mkdir -p "fuzz/found/$target"
  cargo +nightly fuzz run --sanitizer "$(sanitizer "$target")" "$target" \
    "fuzz/found/$target" "fuzz/corpus/$target" -- \
    -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -timeout=120 -max_len=900 \
    -max_total_time="$seconds" -print_final_stats=1
}

failed=0
for target in "${targets[@]}"; do
  echo "== $target, $seconds s"
  run_target "$target" || failed=1
done
exit "$failed"

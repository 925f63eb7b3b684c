# Sourced by test.sh: what lanes took, and what was skipped.

timings=()
# A file: lanes are processes of their own.
readonly skips="$logs/skips"

# took LANE SECONDS
took() {
  timings+=("$(printf '%6s  %s' "$2" "$1")")
}

# skipped WHAT WHY
skipped() {
  echo "skipped: $1: $2"
  echo "$1: $2" >>"$skips"
}

# skips_of_cargo LOG: adds the lines `skipped: REASON` that Rust tests print. What test.sh installs
# must not be missing.
skips_of_cargo() {
  local line
  while read -r line; do
    echo "Rust tests: ${line#skipped: }" >>"$skips"
    case "$line" in
      *"cannot import"*) is_without readers || fail "$line; ./test.sh --without readers allows that" ;;
    esac
  done < <(grep '^skipped: ' "$1" | sort -u)
}

# skips_of_ctest DIRECTORY: adds the tests that its last run of ctest skipped, a line for each reason.
skips_of_ctest() {
  awk '
    sub(/^[0-9]+\/[0-9]+ Testing: /, "") { name = $0 }
    sub(/^SKIP: /, "") { names[$0] = names[$0] " " name }
    END { for (reason in names) print "ctest:" names[reason] ": " reason }' \
    "$1/Testing/Temporary/LastTest.log" | sort >>"$skips"
}

# What a run says at its end, also where it failed.
report() {
  local status=$?
  stop_lanes
  printf '\n== seconds\n'
  printf '%s\n' "${timings[@]}"
  printf '%6s  %s\n' "$SECONDS" "all"
  printf '\n== skipped\n'
  if [ -s "$skips" ]; then cat "$skips"; else echo "nothing"; fi
  [ $status -eq 0 ] || printf '\nfailed\n' >&2
  exit $status
}

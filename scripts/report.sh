# Sourced by test.sh: what lanes took, and what was skipped.

timings=()
# A file: lanes are processes of their own.
readonly skips="$logs/skips"

# took LANE SECONDS
took() {
  timings+=("$(printf '%6s %9s  %s' "$2" "$(processor_seconds "$logs/$1.times")" "$1")")
}

# processor_seconds FILE: the sum of what bash's `times` has written there, user and system; a dash without it.
processor_seconds() {
  [ -e "$1" ] || { echo -; return 0; }
  tr ' ' '\n' <"$1" | awk -F '[ms]' '{ sum += 60 * $1 + $2 } END { printf "%.0f\n", sum }'
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
  printf '\n== seconds, and those of processors\n'
  printf '%s\n' "${timings[@]}"
  printf '%6s %9s  %s\n' "$SECONDS" "$(processor_seconds <(cat "$logs"/*.times 2>/dev/null))" "all"
  printf '\n== skipped\n'
  if [ -s "$skips" ]; then cat "$skips"; else echo "nothing"; fi
  [ $status -eq 0 ] || printf '\nfailed\n' >&2
  exit $status
}

# Sourced by test.sh: lanes, what they took, and what was skipped.

timings=() skips=()

has_lane() {
  [[ " ${lanes[*]} " == *" $1 "* ]]
}

is_without() {
  [[ "$without" == *" $1 "* ]]
}

# timed LANE: runs the function of that lane.
timed() {
  local start=$SECONDS
  step "$1"
  "${1}_lane"
  timings+=("$1 $((SECONDS - start))")
}

# skipped WHAT WHY
skipped() {
  echo "skipped: $1: $2"
  skips+=("$1: $2")
}

# skips_of_cargo LOG: adds the lines `skipped: REASON` that Rust tests print. What test.sh installs
# must not be missing.
skips_of_cargo() {
  local line
  while read -r line; do
    skips+=("Rust tests: ${line#skipped: }")
    case "$line" in
      *"cannot import"*) is_without readers || fail "$line; ./test.sh --without readers allows that" ;;
    esac
  done < <(grep '^skipped: ' "$1" | sort -u)
}

# skips_of_ctest DIRECTORY: adds the tests that its last run of ctest skipped, a line for each reason.
skips_of_ctest() {
  local line
  while read -r line; do
    skips+=("$line")
  done < <(awk '
    sub(/^[0-9]+\/[0-9]+ Testing: /, "") { name = $0 }
    sub(/^SKIP: /, "") { names[$0] = names[$0] " " name }
    END { for (reason in names) print "ctest:" names[reason] ": " reason }' \
    "$1/Testing/Temporary/LastTest.log" | sort)
}

# What a run says at its end, also where it failed.
report() {
  local status=$? line
  printf '\n== seconds\n'
  for line in "${timings[@]}"; do printf '%6s  %s\n' "${line##* }" "${line% *}"; done
  printf '%6s  %s\n' "$SECONDS" "all"
  printf '\n== skipped\n'
  if [ ${#skips[@]} -eq 0 ]; then echo "nothing"; fi
  for line in "${skips[@]}"; do echo "$line"; done
  [ $status -eq 0 ] || printf '\nfailed\n' >&2
  exit $status
}

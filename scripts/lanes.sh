# Sourced by test.sh: runs lanes, two at a time (bash 5.1). While one is on one core, or waits, the other
# has the rest of the machine.

readonly logs="$PWD/target/lanes"
# Of the lanes under way, by process: the name, and the second at which it began.
declare -A running=() began=()

has_lane() {
  [[ " ${lanes[*]} " == *" $1 "* ]]
}

is_without() {
  [[ "$without" == *" $1 "* ]]
}

# run_lanes LANE...: begins them in this order, and fails as soon as one of them does. A single one
# prints at once what it has to say.
run_lanes() {
  local lane at_once=2 start=$SECONDS
  if [ $# -eq 1 ]; then
    step "$1"
    "$1_lane"
    took "$1" $((SECONDS - start))
    return
  fi
  # Two would only be in each other's way.
  [ "$jobs" -gt 1 ] || at_once=1
  for lane in "$@"; do
    [ ${#running[@]} -lt $at_once ] || finish_a_lane
    begin_lane "$lane"
  done
  while [ ${#running[@]} -gt 0 ]; do finish_a_lane; done
}

# In a process group of its own, so that stop_lanes can end all that it has started.
begin_lane() {
  step "$1 begins; it writes to target/lanes/$1.log"
  set -m
  {
    trap "times >'$logs/$1.times'" EXIT
    "$1_lane"
  } >"$logs/$1.log" 2>&1 &
  set +m
  running[$!]="$1"
  began[$!]=$SECONDS
}

# Waits for the next lane that ends, and prints what it has written.
finish_a_lane() {
  local process lane status=0
  wait -n -p process || status=$?
  lane="${running[$process]}"
  unset "running[$process]"
  took "$lane" $((SECONDS - began[$process]))
  step "$lane"
  cat "$logs/$lane.log"
  [ $status -eq 0 ] || fail "$lane failed"
}

stop_lanes() {
  local process
  for process in "${!running[@]}"; do kill -- "-$process" 2>/dev/null || true; done
}

#!/usr/bin/env bash
# Runs the programs of the tests on several numbers of ranks, and compares what they say.
#
#   run.sh messages|same|work|statuses|apart|files|faults PROGRAMS SCRATCH
#
# PROGRAMS: the directory with messages, same_mesh, statuses and netmesh-mpi. SCRATCH: a directory for files.
# NETMESH_MPIRUN: the launcher, mpirun if not given. What cannot run here is a line `SKIP: REASON`.
set -euo pipefail

readonly test="$1" programs="$2" scratch="$3"
readonly here="$(cd "$(dirname "$0")" && pwd)"
mkdir -p "$scratch"

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# ranks NUMBER PROGRAM...: more ranks than cores, and as root in a container.
ranks() {
  local number="$1"
  shift
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
    OMPI_MCA_mpi_yield_when_idle=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe \
    timeout "${limit:-300}" "${NETMESH_MPIRUN:-mpirun}" -np "$number" "$@"
}

# same SHAPE DIM COUNT OUTPUT: one mesh, whatever the ranks and whoever has the points.
same() {
  local number shares first="" said
  for number in 1 2 3 4 8; do
    for shares in even first odd uneven; do
      # All ways to share them out on three ranks, one on the other numbers.
      [ "$number" -eq 3 ] || [ "$shares" = even ] || continue
      said="$(ranks "$number" "$programs/same_mesh" "$1" "$2" "$3" "$shares" "$4")" ||
        fail "$1 in $2D on $number ranks ($shares) fails"
      [ -n "$first" ] || first="$said"
      [ "$said" = "$first" ] || fail "$1 in $2D on $number ranks ($shares): $said, on one: $first"
    done
  done
  echo "$1 $2D $4: $first"
}

messages_test() {
  local number
  for number in 1 2 3 8; do
    ranks "$number" "$programs/messages" || fail "messages between $number ranks fail"
  done
}

same_test() {
  same uniform 2 2000 hierarchical
  same clusters 2 2000 finished
  same lattice 2 900 hierarchical
  same duplicates 2 1500 hierarchical
  same nested 3 1200 hierarchical
  same crowds 3 10000 hierarchical
  same crowds 2 3000 finished
  same sphere 3 1000 hierarchical
  same duplicates 3 900 finished
  same lattice 2 10000 hierarchical
  local scan="${NETMESH_DATA:-$here/../../../shared/data}/isprs_samp11_utm.xyz"
  if [ -e "$scan" ]; then
    same "$scan" 3 10000 hierarchical
  else
    echo "skipped: same mesh of a scan: ${scan##*/} is not in the data directory (set NETMESH_DATA to it)"
  fi
}

# The table of what a run took: partitions are the same on any number of ranks, and the model reads it.
work_test() {
  local directory="$scratch/work" number
  rm -rf "$directory"
  mkdir -p "$directory"
  cd "$directory"
  awk 'BEGIN { srand(7); for (i = 0; i < 20000; i++) print rand(), rand(), rand() }' >points.xyz
  for number in 1 3 8; do
    ranks "$number" "$programs/netmesh-mpi" points.xyz --work "$number.csv" --quiet
    # Phase, number, inputs and simplices of every partition, whoever made it.
    grep '^[0-9]*,partition,' "$number.csv" | cut -d, -f3-6 | sort >"$number.partitions"
    cmp 1.partitions "$number.partitions"
    [ "$(cut -d, -f1 "$number.csv" | sort -u | wc -l)" -eq $((number + 1)) ] || fail "ranks are missing"
  done
  # Several phases, of fewer and fewer partitions.
  [ "$(cut -d, -f1 1.partitions | uniq -c | awk '{ printf "%s ", $1 }')" = "8 8 8 4 2 1 " ] ||
    fail "phases: $(cut -d, -f1 1.partitions | uniq -c)"
  refused 2 'the table would replace the input' 2 points.xyz --work points.xyz
  refused 8 'cannot create' 3 points.xyz --work absent/work.csv
  refused 2 'both the table and the output' 2 points.xyz -o mesh.npy --work mesh.points.npy
  # From its own partitions the model foresees what a run took, and nothing else.
  "${NETMESH_PYTHON:-python3}" "$here/../model/scaling.py" replay 1.csv 1.csv | grep '+0%'
  "${NETMESH_PYTHON:-python3}" "$here/../model/scaling.py" predict 1.csv 8.csv --ranks 64 | grep '^ *64 '
}

statuses_test() {
  local number directory="$scratch/statuses" mounted=""
  rm -rf "$directory"
  mkdir -p "$directory/full"
  # A disk that is full, where one can be had.
  if mount -t tmpfs -o size=16k tmpfs "$directory/full" 2>/dev/null; then
    mounted=1
    # shellcheck disable=SC2064
    trap "umount '$directory/full'" EXIT
  else
    rmdir "$directory/full"
    echo "skipped: statuses of a full disk: no file system can be mounted here"
  fi
  for number in 1 2 3 8; do
    ranks "$number" "$programs/statuses" "$directory"
    [ -z "$mounted" ] || [ -z "$(ls -A "$directory/full")" ] || fail "a full disk keeps $(ls -A "$directory/full")"
    ! ls -A "$directory" | grep -q '\.tmp$' || fail "temporary files stay: $(ls -A "$directory")"
  done
}

# Ranks that are called differently, or see different files: all say so, and none waits for the others.
apart_test() {
  local directory="$scratch/apart" limit=60 number
  rm -rf "$directory"
  mkdir -p "$directory/elsewhere" "$directory/shorter" "$directory/changed" "$directory/there"
  cd "$directory"
  awk 'BEGIN { srand(7); for (i = 0; i < 300; i++) print rand(), rand() }' >in.xyz
  cp in.xyz other.xyz
  tail -n +2 in.xyz >shorter/in.xyz
  tr 123 321 <in.xyz >changed/in.xyz

  apart 2 '--output is "x.npy", on rank 0 it is "x.pvtu"; it must be the same' . 'in.xyz -q -o x.pvtu' 'in.xyz -q -o x.npy'
  apart 2 '--output is "y.npy", on rank 0 it is "x.npy"' . 'in.xyz -q -o x.npy' 'in.xyz -q -o y.npy'
  apart 2 '--output is not given, on rank 0 it is "x.npy"' . 'in.xyz -q -o x.npy' 'in.xyz -q'
  apart 2 '--output-format is Npy, on rank 0 it is Pvtu' . 'in.xyz -o x --output-format pvtu' 'in.xyz -o x --output-format npy'
  apart 2 "the command line is refused (unexpected argument '--nothing' found), on rank 0 it is understood" . \
    'in.xyz -q' 'in.xyz -q --nothing'
  apart 2 "the command line is understood, on rank 0 it is refused (unexpected argument '--nothing' found)" . \
    'in.xyz -q --nothing' 'in.xyz -q'
  apart 2 'the command line is a question (--help, --version), on rank 0' . 'in.xyz -q' '--help'
  apart 2 '--validate is true, on rank 0 it is false' . 'in.xyz -q' 'in.xyz -q --validate'
  apart 2 '--quiet is false, on rank 0 it is true' . 'in.xyz -q' 'in.xyz'
  apart 2 '--work is "w", on rank 0 it is not given' . 'in.xyz -q' 'in.xyz -q --work w'
  apart 2 '--seed is 1, on rank 0 it is 0' . 'in.xyz -q' 'in.xyz -q --seed 1'
  apart 2 'INPUT is "other.xyz", on rank 0 it is "in.xyz"' . 'in.xyz -q' 'other.xyz -q'
  # The same words, in other directories.
  apart 3 'in.xyz: cannot open: No such file' elsewhere 'in.xyz -q' 'in.xyz -q'
  apart 2 "in.xyz: the file's length in bytes is" shorter 'in.xyz -q' 'in.xyz -q'
  apart 2 "in.xyz: a digest of the file's content is" changed 'in.xyz -q' 'in.xyz -q'
  apart 8 'all ranks must see the same directory' elsewhere "$PWD/in.xyz -q -o x.pvtu" "$PWD/in.xyz -q -o x.pvtu"
  apart 8 'all ranks must see the same directory' elsewhere "$PWD/in.xyz -q -o x.npy" "$PWD/in.xyz -q -o x.npy"
  apart 8 'all ranks must see the same directory' elsewhere "$PWD/in.xyz -q --work w" "$PWD/in.xyz -q --work w"
  [ -z "$(ls -A elsewhere)" ] || fail "ranks elsewhere leave $(ls -A elsewhere)"
  [ "$(ls -A | tr '\n' ' ')" = 'changed elsewhere in.xyz other.xyz shorter there ' ] || fail "ranks leave $(ls -A)"

  # Arguments that may differ, and those that are wrong before anything is read.
  ranks 1 "$programs/netmesh-mpi" in.xyz -q -o x.npy --threads 1 : -np 1 "$programs/netmesh-mpi" in.xyz -q -o x.npy --threads 2
  for number in 2 3 4; do
    refused 8 'x_0.vtu: cannot create' "$number" absent.xyz -o /proc/x.pvtu
    refused 8 'cannot create' "$number" absent.xyz -o absent/x.npy
    refused 8 'in.xyz/y_0.vtu: no file can be there' "$number" absent.xyz -o in.xyz/y.pvtu
    refused 2 'the output would replace the input' "$number" x.points.npy -o ./there/../x.npy
  done
  mkdir x_1.vtu
  refused 8 'x_1.vtu: is a directory' 3 absent.xyz -o x.pvtu
  rmdir x_1.vtu
  # Links lead to where files will be.
  ln -s there/points.npy linked.points.npy
  ranks 2 "$programs/netmesh-mpi" in.xyz -q -o linked.npy
  [ -L linked.points.npy ] || fail "a link was replaced"
  cmp there/points.npy x.points.npy
}

# apart CODE WORDS DIRECTORY FIRST OTHERS: the first ranks are called with the words of FIRST here, the others with
# those of OTHERS in DIRECTORY: all exit with that code, and one says so, of the first of the others.
apart() {
  local code="$1" words="$2" directory="$3" first="$4" others="$5" split count status said
  for split in '1 1' '1 2' '3 1'; do
    count="${split% *}" status=0
    # shellcheck disable=SC2086
    said="$(ranks "$count" "$programs/netmesh-mpi" $first : -np "${split#* }" -wdir "$PWD/$directory" \
      "$programs/netmesh-mpi" $others 2>&1)" || status=$?
    [ "$status" -eq "$code" ] || fail "$first | $others: exit code $status, $code expected: $said"
    [ "$(grep -cF -- "$words" <<<"$said")" -eq 1 ] || fail "$first | $others: '$words' is not said once: $said"
    grep -q "(rank $count)" <<<"$said" || fail "$first | $others: not said of rank $count: $said"
  done
}

# Files that others can read, of points that ranks have read by parts.
files_test() {
  local python="${NETMESH_PYTHON:-python3}" directory="$scratch/files" dim number program="$programs/netmesh-mpi"
  if ! "$python" -c 'import numpy, vtk, meshio' 2>/dev/null; then
    echo "SKIP: cannot import numpy, vtk and meshio"
    return
  fi
  rm -rf "$directory"
  mkdir -p "$directory"
  cd "$directory"
  "$python" "$here/points.py"
  for dim in 2 3; do
    for number in 1 3 8; do
      ranks "$number" "$program" "in$dim.npy" -o "out$dim.pvtu" --quiet --validate
      ranks "$number" "$program" "in$dim.npy" -o "out$dim.npy" --quiet
      "$python" "$here/readers.py" "in$dim.npy" "$directory/out$dim"
      # The same points as text, and where ids do not depend on ranks the same bytes.
      ranks "$number" "$program" "in$dim.xyz" -o "text$dim.npy" --quiet
      cmp "text$dim.points.npy" "out$dim.points.npy"
      cmp "text$dim.simplices.npy" "out$dim.simplices.npy"
      [ "$number" -gt 1 ] || cp "out$dim.points.npy" "one$dim.npy"
      cmp "one$dim.npy" "out$dim.points.npy"
    done
  done
  refused 3 'line 1202, column 2: "x" is not a number' 4 bad.xyz
  refused 3 'the file holds no points' 4 empty.xyz
  printf '3\n0 0\n1 0\n0 1\n' >counted.xyz
  refused 3 'line 1: 3 is a number of points' 4 counted.xyz
  refused 3 'cannot open' 4 absent.npy
  refused 4 'point 3 has the non-finite coordinate 1' 4 nan.npy
  refused 2 '--bound is 1; it must be' 4 in2.npy --bound 1
  refused 2 "unexpected argument '--nothing'" 2 in2.npy --nothing
  refused 8 'cannot create' 3 in2.npy -o absent/out.pvtu
  refused 8 'cannot create' 3 in2.npy -o absent/out.npy
}

# refused CODE WORDS NUMBER ARGUMENT...: all ranks exit with that code, and one says so.
refused() {
  local code="$1" words="$2" number="$3" status=0 said
  shift 3
  said="$(ranks "$number" "$programs/netmesh-mpi" "$@" 2>&1)" || status=$?
  [ "$status" -eq "$code" ] || fail "$*: exit code $status, $code expected: $said"
  [ "$(grep -cF -- "$words" <<<"$said")" -eq 1 ] || fail "$*: '$words' is not said once: $said"
}

# faults: memory that one rank does not get, and a rank that is killed.
faults_test() {
  local directory="$scratch/faults" limit status refusals=0 said
  rm -rf "$directory"
  mkdir -p "$directory"
  cd "$directory"
  awk 'BEGIN { srand(7); for (i = 0; i < 30000; i++) print rand(), rand(), rand() }' >points.xyz
  for limit in 100 150 200 250 300 350 400 500 600 800; do
    status=0
    # Rank 1 has so many MiB beside what it has when it begins.
    said="$(ranks 3 bash -c 'rank="${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-0}}"
      [ "$rank" -ne 1 ] || ulimit -v $(('"$limit"' * 1024))
      exec "$0" "$@"' "$programs/netmesh-mpi" points.xyz -o mesh.pvtu --quiet 2>&1)" || status=$?
    case "$status" in
      0) [ -e mesh.pvtu ] || fail "a mesh of $limit MiB is missing" ;;
      5)
        refusals=$((refusals + 1))
        grep -q '(rank 1)' <<<"$said" || fail "$limit MiB: $said"
        [ -z "$(ls -A | grep -v points.xyz)" ] || fail "$limit MiB leave $(ls -A)"
        ;;
      # MPI itself, or the loader, had not enough to begin.
      *) ! grep -q netmesh-mpi: <<<"$said" || fail "$limit MiB: exit code $status: $said" ;;
    esac
    rm -f mesh*
  done
  [ "$refusals" -gt 0 ] || fail "no rank was refused memory"
  echo "$refusals refusals of memory on one rank were statuses on all"
  killed_ranks
}

# A rank is killed at some time: no index without its pieces, no array that is cut off.
killed_ranks() {
  local delay victim complete=0 ended=0
  for delay in 0.2 0.5 0.8 1.1 1.4 1.7 2.0 2.3 2.6; do
    rm -f mesh* .netmesh-mpi-*
    ranks 3 "$programs/netmesh-mpi" points.xyz -o mesh.pvtu --quiet >/dev/null 2>&1 &
    local job=$!
    sleep "$delay"
    victim="$(pgrep -f "$programs/netmesh-mpi points.xyz -o mesh.pvtu --quiet" | tail -1)" || victim=""
    [ -z "$victim" ] || kill -KILL "$victim" 2>/dev/null || true
    wait "$job" && complete=$((complete + 1)) || ended=$((ended + 1))
    if [ -e mesh.pvtu ]; then
      for piece in mesh_0.vtu mesh_1.vtu mesh_2.vtu; do
        [ "$(tail -c 11 "$piece")" = "</VTKFile>" ] || fail "$piece is cut off"
      done
    fi
  done
  [ "$ended" -gt 0 ] || fail "no job was ended"
  echo "$ended jobs ended with a killed rank, $complete were faster"
}

"${test}_test"

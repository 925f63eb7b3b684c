# Sourced by test.sh: the library and the program on MPI (mpi/), the member of the workspace that needs MPI.

# use_mpi: names the compiler's wrapper, so that cargo and CMake ask for the same build.
use_mpi() {
  export MPICC="${MPICC:-$(command -v mpicc)}"
}

# Built as for the Rust tests, with assertions and checks of overflow: the library is there already.
mpi_lane() {
  if is_without mpi; then
    skipped "mpi" "--without mpi"
    return 0
  fi
  local place="$PWD/target/mpi" log="$PWD/target/mpi_tests.log"
  cargo test --package netmesh-mpi --locked | tee "$log"
  cmake -S . -B "$place" -DCMAKE_BUILD_TYPE=Release -DNETMESH_BUILD_MPI=ON -DNETMESH_BUILD_BENCHMARKS=OFF \
    -DNETMESH_BUILD_CLI=OFF -DNETMESH_CARGO_PROFILE=dev -DNETMESH_CARGO_TARGET_DIR="$PWD/target" \
    -DNETMESH_PYTHON="$venv/bin/python"
  cmake --build "$place" --target netmesh_mpi_tests --parallel "$jobs"
  ctest --test-dir "$place" --label-regex '^mpi$' --output-on-failure
  skips_of_ctest "$place"
}

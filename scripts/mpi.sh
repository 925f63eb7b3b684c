# Sourced by test.sh: the library and the program on MPI (mpi/), a package outside the workspace.

mpi_lane() {
  if is_without mpi; then
    skipped "mpi" "--without mpi"
    return 0
  fi
  local place="$PWD/target/mpi" manifest="$PWD/mpi/Cargo.toml" log="$PWD/target/mpi_tests.log"
  mkdir -p "$place"
  cargo fmt --manifest-path "$manifest" --check
  # Assertions and checks of overflow, in the library too; and one directory, so that it compiles once.
  local build=(--manifest-path "$manifest" --target-dir "$place/cargo/mpi" --locked)
  cargo clippy "${build[@]}" --all-targets -- -D warnings
  cargo test "${build[@]}" | tee "$log"
  cmake -S . -B "$place/cmake" -DCMAKE_BUILD_TYPE=Release -DNETMESH_BUILD_MPI=ON -DNETMESH_BUILD_BENCHMARKS=OFF \
    -DNETMESH_BUILD_CLI=OFF -DNETMESH_CARGO_PROFILE=dev -DNETMESH_CARGO_TARGET_DIR="$place/cargo" \
    -DNETMESH_PYTHON="$venv/bin/python"
  cmake --build "$place/cmake" --target netmesh_mpi_tests --parallel "$jobs"
  ctest --test-dir "$place/cmake" --label-regex '^mpi$' --output-on-failure
  skips_of_ctest "$place/cmake"
}

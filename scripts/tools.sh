# Sourced by test.sh: the pinned tools, each in its place under target/.

readonly NUMPY_VERSION=2.3.5 MESHIO_VERSION=5.3.5 RICH_VERSION=14.2.0 GMSH_VERSION=4.15.2 VTK_VERSION=9.7.2

need_rust_components() {
  if cargo fmt --version && cargo clippy --version; then
    return 0
  elif has rustup; then
    rustup component add rustfmt clippy
  else
    need_packages rustfmt rust-clippy
  fi
}

# What reads in tests what netmesh has written: the readers and what they import, not what else they
# could draw with.
need_readers() {
  if is_without readers; then
    skipped "readers" "--without readers"
    return 0
  fi
  need_packages python3-venv libglu1-mesa libgl1 libxcursor1 libxft2 libxinerama1 libgomp1
  local wanted=("numpy==$NUMPY_VERSION" "meshio==$MESHIO_VERSION" "rich==$RICH_VERSION" "gmsh==$GMSH_VERSION" "vtk==$VTK_VERSION")
  if [ "$(cat "$venv/readers" 2>/dev/null)" != "${wanted[*]}" ]; then
    python3 -m venv --clear "$venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --no-compile --only-binary :all: \
      "${wanted[@]}" || fail "cannot install the readers; without them: ./test.sh --without readers"
    echo "${wanted[*]}" >"$venv/readers"
  fi
  echo "${wanted[*]}"
}

# Miri runs the tests of the unsafe code under a checker for undefined behaviour; only a nightly has it.
miri_toolchain() {
  has rustup || return 0
  local toolchain
  for toolchain in $(rustup toolchain list | sed -n 's/^\(nightly[^ ]*\).*/\1/p'); do
    if rustup component list --toolchain "$toolchain" --installed 2>/dev/null | grep -q '^miri'; then
      echo "$toolchain"
      return 0
    fi
  done
}

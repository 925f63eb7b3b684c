# Sourced by test.sh: the pinned tools, each in its place under target/.

readonly CBINDGEN_VERSION=0.29.0
readonly MESHIO_VERSION=5.3.5 GMSH_VERSION=4.15.2 VTK_VERSION=9.7.2

need_rust_components() {
  if cargo fmt --version && cargo clippy --version; then
    return 0
  elif has rustup; then
    rustup component add rustfmt clippy
  else
    need_packages rustfmt rust-clippy
  fi
}

# cbindgen makes include/netmesh.h; another version may format it differently.
need_cbindgen() {
  local wanted="cbindgen $CBINDGEN_VERSION"
  [ "$(cbindgen --version 2>/dev/null)" = "$wanted" ] ||
    cargo install cbindgen --version "$CBINDGEN_VERSION" --locked --root "$tools"
  cbindgen --version
}

# What reads in tests what netmesh has written. Of vtk without what it depends on: that is for drawing.
# Where gmsh or vtk cannot be had, on another processor for example, their tests say so and pass.
need_readers() {
  local wanted="meshio $MESHIO_VERSION, gmsh $GMSH_VERSION, vtk $VTK_VERSION"
  if [ "$(cat "$venv/readers" 2>/dev/null)" != "$wanted" ]; then
    python3 -m venv --clear "$venv"
    local pip=("$venv/bin/pip" install --quiet --disable-pip-version-check)
    "${pip[@]}" "meshio==$MESHIO_VERSION"
    "${pip[@]}" --no-deps "gmsh==$GMSH_VERSION" || echo "there is no gmsh here"
    "${pip[@]}" --no-deps "vtk==$VTK_VERSION" || echo "there is no vtk here"
    echo "$wanted" >"$venv/readers"
  fi
  "$venv/bin/pip" list --format=freeze --disable-pip-version-check | grep --extended-regexp '^(meshio|gmsh|vtk|numpy)=='
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

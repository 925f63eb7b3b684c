# Sourced by test.sh: the pinned tools, each in its place under target/.

readonly CBINDGEN_VERSION=0.29.0
readonly MESHIO_VERSION=5.3.5

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

# meshio reads in tests what netmesh has written.
need_meshio() {
  local wanted="$MESHIO_VERSION"
  if [ "$(meshio_version)" != "$wanted" ]; then
    python3 -m venv --clear "$venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check "meshio==$wanted"
  fi
  echo "meshio $(meshio_version)"
}

meshio_version() {
  "$venv/bin/python3" -c 'import meshio; print(meshio.__version__)' 2>/dev/null || true
}

# Miri runs the C ABI's tests under a checker for undefined behaviour; only a nightly has it.
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

# Sourced by test.sh: the Python package, as wheel and as source distribution.

readonly PYTHON_NUMPY_VERSION=2.3.5 SCIPY_VERSION=1.17.1 MATURIN_VERSION=1.16.0 PYTEST_VERSION=9.2.0
readonly TQDM_VERSION=4.67.1

# Builds the wheel from the source distribution, which so has what it needs, installs it into a fresh
# environment and tests it there. The environment of the tools has what the tests compare with.
python_lane() {
  if is_without python; then
    skipped "python" "--without python"
    return 0
  fi
  local place="$PWD/target/python" python
  need_python_tools
  cargo fmt --manifest-path python/Cargo.toml --check
  CARGO_TARGET_DIR="$place" cargo clippy --manifest-path python/Cargo.toml --release --locked -- -D warnings
  rm -rf "$place/dist" "$place/fresh"
  "$place/tools/bin/maturin" sdist --out "$place/dist"
  python3 scripts/unpack.py "$place"/dist/netmesh-*.tar.gz "$place/source"
  CARGO_TARGET_DIR="$place" PATH="$place/tools/bin:$PATH" \
    "$place/tools/bin/pip" wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation \
    --wheel-dir "$place/dist" "$place"/source
  python3 -m venv --without-pip "$place/fresh"
  python="$place/fresh/bin/python"
  "$place/tools/bin/pip" --python "$python" install --quiet --disable-pip-version-check --only-binary :all: \
    "numpy==$PYTHON_NUMPY_VERSION" "$place"/dist/netmesh-*.whl
  (
    cd "$place"
    PYTHONPATH="$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')" \
      tools/bin/python -m pytest -p no:cacheprovider --quiet --strict-markers -ra "$OLDPWD/python/tests"
  )
}

need_python_tools() {
  need_packages python3-venv
  local wanted=("numpy==$PYTHON_NUMPY_VERSION" "scipy==$SCIPY_VERSION" "maturin==$MATURIN_VERSION"
    "pytest==$PYTEST_VERSION" "tqdm==$TQDM_VERSION")
  local place="$PWD/target/python/tools"
  if [ "$(cat "$place/wanted" 2>/dev/null)" != "${wanted[*]}" ]; then
    python3 -m venv --clear "$place"
    "$place/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: "${wanted[@]}" ||
      fail "cannot install what tests the Python package; without it: ./test.sh --without python"
    echo "${wanted[*]}" >"$place/wanted"
  fi
  echo "${wanted[*]}"
}

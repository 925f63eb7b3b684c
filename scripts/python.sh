# Sourced by test.sh: the Python package, as wheel and as source distribution.

readonly PYTHON_PACKAGES=(numpy==2.4.6 scipy==1.17.1 maturin==1.16.0 pytest==9.2.0 mypy==2.4.1 tqdm==4.70.1
  matplotlib==3.11.2 pyvista==0.49.1 "meshio==$MESHIO_VERSION" "vtk==$VTK_VERSION" gudhi==3.13.0 triangle==20250106
  scikit-fem==12.0.2 shapely==2.2.0 geopandas==1.2.0 trimesh==5.2.0)

# Builds the wheel from the source distribution, which so has what it needs, installs it into a fresh
# environment and tests it there. The environment of the tools has what the tests compare with.
python_lane() {
  if is_without python; then
    skipped "python" "--without python"
    return 0
  fi
  local place="$PWD/target/python" log="$PWD/target/python_tests.log" packages
  need_python_tools
  cargo fmt --manifest-path python/Cargo.toml --check
  "$place/tools/bin/mypy" --disallow-untyped-defs --ignore-missing-imports --cache-dir "$place/mypy" python/netmesh
  rm -rf "$place/dist" "$place/fresh"
  "$place/tools/bin/maturin" sdist --out "$place/dist"
  python3 scripts/unpack.py "$place"/dist/netmesh-*.tar.gz "$place/source"
  build_wheel "$place"
  python3 -m venv --without-pip "$place/fresh"
  "$place/tools/bin/pip" --python "$place/fresh/bin/python" install --quiet --disable-pip-version-check \
    --no-compile --only-binary :all: "${PYTHON_PACKAGES[0]}" "$place"/dist/netmesh-*.whl
  # The wheel and NumPy alone run the first page that people read.
  (cd "$place" && fresh/bin/python "$OLDPWD/python/tests/run_page.py" "$OLDPWD/docs/python.md")
  packages="$("$place/fresh/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')"
  (cd "$place" && PYTHONPATH="$packages" tools/bin/python -m pytest -p no:cacheprovider --quiet --tb=short -rsx \
    -W ignore::pytest.PytestUnknownMarkWarning "$OLDPWD/python/tests") | tee "$log"
  while read -r line; do
    skipped "Python tests" "$line"
  done < <(sed -n 's/^SKIPPED //p' "$log")
}

# build_wheel PLACE: of the source that is unpacked there. The library compiles for longer than it is
# tested: less optimisation makes up for slower tests. Clippy compiles the package and has its
# say while it does; to check it apart would take the library once more.
build_wheel() {
  local place="$1"
  CARGO_TARGET_DIR="$place" CARGO_PROFILE_RELEASE_OPT_LEVEL=1 RUSTC_WORKSPACE_WRAPPER=clippy-driver \
    RUSTFLAGS=-Dwarnings PATH="$place/tools/bin:$PATH" \
    "$place/tools/bin/pip" wheel --quiet --disable-pip-version-check --no-deps --no-build-isolation \
    --wheel-dir "$place/dist" "$place/source"
}

need_python_tools() {
  local place="$PWD/target/python/tools"
  if [ "$(cat "$place/wanted" 2>/dev/null)" != "${PYTHON_PACKAGES[*]}" ]; then
    python3 -m venv --clear "$place"
    "$place/bin/pip" install --quiet --disable-pip-version-check --no-compile --only-binary :all: \
      "${PYTHON_PACKAGES[@]}" ||
      fail "cannot install what tests the Python package; without it: ./test.sh --without python"
    echo "${PYTHON_PACKAGES[*]}" >"$place/wanted"
  fi
  echo "${PYTHON_PACKAGES[*]}"
}

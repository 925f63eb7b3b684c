#!/usr/bin/env bash
# wheels.sh [FOLDER]: makes what PyPI gets, in FOLDER (target/wheels): the source distribution, and of
# it a wheel for Linux on x86-64 and one on aarch64, for CPython 3.9 and later and glibc 2.17 and later.
# That of this machine's processor is tested where no compiler is. Needs rustup for the other one.
#
# wheels.sh test [WHEEL]: runs all tests of the Python package with a wheel where no compiler is; without
# WHEEL it makes that of this machine's processor, as above. PYTHON=python3.9 tests with that Python; packages
# that have no wheel for it are left out, and what is skipped says why.
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=scripts/common.sh
. scripts/common.sh
# shellcheck source=scripts/tools.sh
. scripts/tools.sh
# shellcheck source=scripts/python.sh
. scripts/python.sh

readonly TOOLS=("maturin==1.16.0" "ziglang==0.17.1") TAG=manylinux2014
readonly TARGETS=(x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu)
place="$PWD/target/wheel_tools" tools="$PWD/target/wheel_tools/tools" fresh="$PWD/target/wheel_tools/fresh"

make_tools() {
  python3 -m venv --clear "$tools"
  "$tools/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: "${TOOLS[@]}"
}

# make_source FOLDER: the source distribution, unpacked, too.
make_source() {
  make_tools
  "$tools/bin/maturin" sdist --out "$1"
  python3 scripts/unpack.py "$1"/netmesh-*.tar.gz "$place/source"
}

# make_wheel TARGET FOLDER: of the source distribution, as a user's pip would.
make_wheel() {
  if ! rustc --print target-libdir --target "$1" | xargs test -d; then
    rustup target add "$1"
  fi
  PATH="$tools/bin:$PATH" CARGO_TARGET_DIR="$PWD/target/wheel_builds" \
    maturin build --manifest-path "$place/source/python/Cargo.toml" --release --strip --zig \
    --target "$1" --compatibility "$TAG" --out "$2"
}

# install PACKAGE...: into the fresh environment.
install() {
  "$fresh/bin/python" -m pip install --quiet --disable-pip-version-check --only-binary :all: "$@"
}

# where_no_compiler_is COMMAND...: in the fresh environment, where no program but its own can be found.
where_no_compiler_is() {
  (cd "$place" && env -i PATH="$fresh/bin" HOME="$place" "$@")
}

# make_fresh WHEEL: an environment with the wheel and NumPy alone.
make_fresh() {
  "${PYTHON:-python3}" -m venv --clear "$fresh"
  install "$1"
  where_no_compiler_is "$fresh/bin/python" -c '
import shutil, sys
found = [name for name in ("cc", "gcc", "g++", "c++", "clang", "cargo", "rustc", "zig") if shutil.which(name)]
sys.exit(f"there is a compiler: {found}" if found else 0)'
}

# test_page: the page that people read first runs.
test_page() {
  where_no_compiler_is "$fresh/bin/python" "$PWD/python/tests/run_page.py" "$PWD/docs/python.md"
}

# install_peers: what the tests compare with, in the versions of the lane `python` or else in the latest that
# has a wheel for this Python.
install_peers() {
  local package name
  for package in "${PYTHON_PACKAGES[@]}"; do
    name="${package%%==*}"
    if [ "$name" != maturin ] && ! install "$package" 2>/dev/null && ! install "$name"; then
      echo "skipped: $name: no wheel for $("$fresh/bin/python" --version)"
    fi
  done
}

# test_suite: the tests of the checkout, all of them, with the package that is installed.
test_suite() {
  where_no_compiler_is "$fresh/bin/python" -c 'import netmesh; print("tested:", netmesh.__file__)'
  where_no_compiler_is "$fresh/bin/python" -m pytest -p no:cacheprovider --quiet --tb=short -rsx --durations=5 \
    -W ignore::pytest.PytestUnknownMarkWarning "$PWD/python/tests"
}

make_all() {
  local folder
  folder="$(realpath --canonicalize-missing "${1:-target/wheels}")"
  rm -rf "$folder"
  make_source "$folder"
  for target in "${TARGETS[@]}"; do
    make_wheel "$target" "$folder"
  done
  make_fresh "$folder"/netmesh-*"$(uname -m)".whl
  test_page
  ls -l "$folder"
}

test_wheel() {
  local folder="$place/tested" wheel
  if [ $# -gt 0 ]; then
    wheel="$(realpath "$1")"
  else
    rm -rf "$folder"
    make_source "$folder"
    make_wheel "$(uname -m)-unknown-linux-gnu" "$folder"
    wheel="$(echo "$folder"/*.whl)"
  fi
  make_fresh "$wheel"
  test_page
  install_peers
  test_suite
}

case "${1:-}" in
  test) shift && test_wheel "$@" ;;
  *) make_all "$@" ;;
esac

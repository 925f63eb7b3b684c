#!/usr/bin/env bash
# wheels.sh [FOLDER]: makes what PyPI gets, in FOLDER (target/wheels): the source distribution, and of
# it a wheel for Linux on x86-64 and one on aarch64, for CPython 3.9 and later and glibc 2.17 and later.
# That of this machine's processor is tested where no compiler is. Needs rustup for the other one.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly TOOLS=("maturin==1.16.0" "ziglang==0.17.1") TAG=manylinux2014
readonly TARGETS=(x86_64-unknown-linux-gnu aarch64-unknown-linux-gnu)
folder="$(realpath --canonicalize-missing "${1:-target/wheels}")"
place="$PWD/target/wheel_tools"

make_tools() {
  python3 -m venv --clear "$place"
  "$place/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: "${TOOLS[@]}"
}

# make_wheel TARGET: of the source distribution, as a user's pip would.
make_wheel() {
  if ! rustc --print target-libdir --target "$1" | xargs test -d; then
    rustup target add "$1"
  fi
  PATH="$place/bin:$PATH" CARGO_TARGET_DIR="$PWD/target/wheel_builds" \
    maturin build --manifest-path "$place/source/python/Cargo.toml" --release --strip --zig \
    --target "$1" --compatibility "$TAG" --out "$folder"
}

# test_wheel WHEEL: the page that people read first runs with the wheel and NumPy alone, and no program
# but Python can be found.
test_wheel() {
  local fresh="$place/fresh"
  python3 -m venv --clear --without-pip "$fresh"
  "$place/bin/pip" --python "$fresh/bin/python" install --quiet --disable-pip-version-check \
    --only-binary :all: "$1"
  (cd "$place" && env -i PATH="$fresh/bin" HOME="$place" "$fresh/bin/python" -c '
import shutil, sys
found = [name for name in ("cc", "gcc", "clang", "cargo", "rustc", "zig") if shutil.which(name)]
sys.exit(f"there is a compiler: {found}" if found else 0)')
  (cd "$place" && env -i PATH="$fresh/bin" HOME="$place" \
    "$fresh/bin/python" "$OLDPWD/python/tests/run_page.py" "$OLDPWD/docs/python.md")
}

rm -rf "$folder"
make_tools
"$place/bin/maturin" sdist --out "$folder"
python3 scripts/unpack.py "$folder"/netmesh-*.tar.gz "$place/source"
for target in "${TARGETS[@]}"; do
  make_wheel "$target"
done
test_wheel "$folder"/netmesh-*"$(uname -m)".whl
ls -l "$folder"

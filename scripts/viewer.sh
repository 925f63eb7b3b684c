#!/usr/bin/env bash
# Makes src/io/html/three.min.js, the part of three.js that is in each file of the format HTML: what viewer.js
# calls, without the shaders and the extras of three.js, which it does not use. Needs npm, and a network. The
# versions are pinned, so that the same bytes come again; with `check` nothing is written, and it fails if they
# do not.
#
#   scripts/viewer.sh [check]
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=scripts/common.sh
. scripts/common.sh

readonly THREE_VERSION=0.187.0 ESBUILD_VERSION=0.28.2
readonly library=src/io/html/three.min.js place=target/viewer

has npm || fail "npm is needed (Debian: apt-get install npm)"
mkdir -p "$place"
cp scripts/viewer_library.mjs "$place/library.mjs"
(cd "$place" && npm install --silent --no-audit --no-fund --no-save --ignore-scripts --prefix . \
  "three@$THREE_VERSION" "esbuild@$ESBUILD_VERSION")
(cd "$place" && node library.mjs "$THREE_VERSION" three.min.js)
case "${1:-}" in
  check) cmp "$place/three.min.js" "$library" ;;
  "") cp "$place/three.min.js" "$library" ;;
  *) fail "usage: scripts/viewer.sh [check]" ;;
esac
wc -c "$library"

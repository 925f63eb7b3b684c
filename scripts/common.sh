# Sourced by the scripts at the root: headings, Debian packages, cargo.

step() {
  printf '\n== %s (%ss)\n' "$1" "$SECONDS"
}

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

has() {
  command -v "$1" >/dev/null 2>&1
}

# as_root COMMAND...: runs it as root, or answers 1 where there is no way to.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif has sudo && sudo -n true 2>/dev/null; then
    sudo -n "$@"
  else
    return 1
  fi
}

package_is_installed() {
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# need_packages NAME...: installs the Debian packages that are missing.
need_packages() {
  local missing=() package
  if ! has apt-get; then
    echo "no apt-get here; these Debian packages, or what stands for them, are needed: $*"
    return 0
  fi
  for package in "$@"; do
    package_is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "installing ${missing[*]}"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes)
  { as_root "${apt[@]}" update && as_root "${apt[@]}" install --no-install-recommends "${missing[@]}"; } ||
    fail "cannot install packages; as root: apt-get install ${missing[*]}"
}

# rustup puts cargo where a shell that has not been started anew does not look.
need_cargo() {
  has cargo || PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"
  has cargo || fail "cargo is needed: https://rustup.rs or Debian's package cargo (1.86 or later)"
}

# Rust links with the C compiler, which rustup does not bring along.
need_linker() {
  has cc || need_packages gcc libc6-dev
}

#!/usr/bin/env bash
# aarch64.sh [all] [PACKAGE...]: builds tests of portable packages, or of these, for aarch64 and runs them under qemu-user. Like
# tools.sh it installs what it can and says what. Rust's library for aarch64 comes from rustup, or else from Debian beside Debian's
# own compiler. Prints how long each package took; the last line counts the tests. It fails if a test fails or none ran.
#
# qemu computes floating point in software, some ten times slower than the machine does. Without `all`, the other plugins are left
# out, which share their code with those that are tested, and checks that spend nearly all of their time on brute-force answers or
# on sheer numbers: what they call is called by others too (see `slow`).
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive PATH="$HOME/.cargo/bin:$PATH"
target=aarch64-unknown-linux-gnu

# Cargo calls it so with a test program, in the folder of the program's package. The template in C is built with CC.
if [ "${1:-}" = run ]; then
  started=${EPOCHREALTIME/[.,]/} code=0
  CC=aarch64-linux-gnu-gcc qemu-aarch64 -L /usr/aarch64-linux-gnu "${@:2}" || code=$?
  name=${2##*/}
  echo "aarch64: ${PWD##*/} ${name%-*} in $(((${EPOCHREALTIME/[.,]/} - started) / 100000)) tenths of a second"
  exit $code
fi

cd "$(dirname "$0")/../.."
. tests/setup/count.sh
have() { command -v "$1" >/dev/null 2>&1; }
say() { printf 'aarch64: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }
install() {
  have apt-get || die "please install these (Debian's names) and run it again: $*"
  [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null || die "missing: $*. Run: sudo apt-get install --no-install-recommends $*"
  say "installing with apt-get: $*"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# The arm64 package of Debian's library, unpacked into .tools; the package lists of arm64 are kept apart from the machine's.
debian_library() {
  local version apt=$PWD/.tools/aarch64/apt
  version=$(dpkg-query -W -f '${Version}' rustc-web)
  [ "$(cat .tools/aarch64/complete 2>/dev/null)" != "$version" ] || return 0
  say "unpacking Debian's libstd-rust-web-dev $version for arm64 into .tools/aarch64"
  rm -rf .tools/aarch64
  mkdir -p "$apt"/{lists,cache}/partial
  touch "$apt/status"
  local options=(-qq -o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State::Lists="$apt/lists"
    -o Dir::State::Status="$apt/status" -o Dir::Cache="$apt/cache" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update
  (cd "$apt" && apt-get "${options[@]}" download "libstd-rust-web-dev:arm64=$version")
  dpkg-deb -x "$apt"/libstd-rust-web-dev_*.deb .tools/aarch64
  rm -r "$apt"
  echo "$version" > .tools/aarch64/complete
}

missing=()
have aarch64-linux-gnu-gcc || missing+=(gcc-aarch64-linux-gnu)
[ -e /usr/aarch64-linux-gnu/lib/crt1.o ] || missing+=(libc6-dev-arm64-cross)
have qemu-aarch64 || missing+=(qemu-user)
have cc || missing+=(build-essential)
have python3 || missing+=(python3)
[ ${#missing[@]} -eq 0 ] || install "${missing[@]}"

# The toolchain of rust-toolchain.toml may be missing as well.
from_rustup() {
  local wanted
  wanted=$(sed -n 's/^channel = "\(.*\)"/\1/p' rust-toolchain.toml)
  rustup target list --toolchain "$wanted" --installed 2>/dev/null | grep -qx "$target" ||
    rustup toolchain install "$wanted" --profile minimal --no-self-update --target "$target"
}

if ! { have rustup && from_rustup; }; then
  say "no rustup that can get Rust's library for aarch64: taking Debian's compiler"
  missing=()
  dpkg-query -W -f '${Status}' rustc-web 2>/dev/null | grep -q ' installed$' || missing+=(rustc-web)
  have cargo || missing+=(cargo-web)
  [ ${#missing[@]} -eq 0 ] || install "${missing[@]}"
  debian_library
  export RUSTC=/usr/bin/rustc CARGO_ENCODED_RUSTFLAGS="--sysroot=$PWD/.tools/aarch64/usr"
fi

# `lanes` and `hierarchy` have no tests of their own: ocb-fast, simdop and box-tree are theirs.
packages=(ocb-lanes ocb-triangles ocb-hierarchy ocb-wide ocb-core ocb-fields ocb-fast ocb-simdop ocb-box-tree
  ocb-chart ocb-citation ocb-stability ocb-advice ocb-model opencollbench-plugin)
others=(ocb-auto ocb-brute-force ocb-dop-tree ocb-obb-tree ocb-restricted-box-tree ocb-rss-tree ocb-sphere-tree ocb-convex
  ocb-v-clip ocb-convex-parts ocb-distance-field ocb-inner-spheres ocb-voxmap-pointshell ocb-parry)
slow=(at_every_gap in_odd_units_and_places whatever_the_winding_and_the_order with_rotations_not_quite
  counts_between_the_steps counts_shape_and_winding half_of_the_controls_cross the_same_winner_at the_grid_covers_more
  random_poses_agree_with_the_winding_number brute_force:: cgal:: distances_agree_with_four every_kind_of_pair)
# The compilers that these call build for this machine.
skip=(the_cpp_ the_rust_template_answers)
if [ "${1:-}" = all ]; then
  shift
  packages+=("${others[@]}")
else
  skip+=("${slow[@]}")
  export OCB_PAIRS=${OCB_PAIRS:-10000}
fi
[ $# -eq 0 ] || packages=("$@")

export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER="tests/setup/aarch64.sh run"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
started=$SECONDS code=0
cargo test --release --locked --target "$target" --tests --no-run "${packages[@]/#/--package=}" || die "the tests do not compile"
built=$SECONDS
cargo test --release --locked --target "$target" --tests --no-fail-fast "${packages[@]/#/--package=}" -- "${skip[@]/#/--skip=}" \
  2>&1 | tee "$log" || code=$?
read -r passed failed < <(counts "$log")
reasons=$(not_run "$log")
not_run=$(awk '{ n += $1 } END { print n + 0 }' <<< "$reasons")
failed=$((failed - not_run + $(uncounted "$log")))
[ "$code" -eq 0 ] || [ $((failed + not_run)) -gt 0 ] || failed=1
awk '/^aarch64: .* tenths of a second$/ { tenths[$2] += $5; all += $5 }
  END { for (each in tenths) printf "%7.1f s  %s\n", tenths[each] / 10, each; printf "%7.1f s  all\n", all / 10 }' "$log" | sort -n
printf '%s\n' "$reasons" | sed '/^$/d'
echo "aarch64: $passed passed, $failed failed under qemu; built in $((built - started)) s, run in $((SECONDS - built)) s"
[ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]

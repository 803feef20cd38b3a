#!/usr/bin/env bash
# The whole proof, as `make test` and CI run it. Every step runs even when an earlier one failed, each one's output is kept
# in target/test-logs, and the last line is "N passed, N failed" summed over all test programs.
set -uo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
tests/setup/tools.sh test || exit 1
export PATH="$root/.tools/node_modules/.bin:$HOME/.cargo/bin:$PATH" NO_COLOR=1 CARGO_TERM_COLOR=never CI=1
export OCB_SHARED=${OCB_SHARED:-$root/../shared}
[ -d "$OCB_SHARED/meshes" ] || echo "test: $OCB_SHARED/meshes is missing; tests on real objects are not run (set OCB_SHARED)"

logs=target/test-logs
rm -rf "$logs" && mkdir -p "$logs"
broken=()
step() { # step NAME COMMAND...: run it, keep its output, remember a failure
  local name=$1 started=$SECONDS
  shift
  echo "== $name: $*"
  if "$@" 2>&1 | tee "$logs/$name.log"; then
    echo "== $name: ok, $((SECONDS - started)) s"
  elif [ "$name" = rust ] && only_not_run "$logs/rust.log"; then
    echo "== $name: ok but for tests that were not run, $((SECONDS - started)) s"
  else
    broken+=("$name")
    echo "== $name: FAILED, $((SECONDS - started)) s"
  fi
}

. tests/setup/count.sh
. tests/setup/services.sh
beside=
trap 'stop_services; [ -z "$beside" ] || kill "$beside" 2>/dev/null || true' EXIT
trap 'exit 130' INT TERM

# All programs at once: the tests' dependencies give a crate another feature, and without them half of it is built again.
step build bash -c 'make -sk --jobs=3 pages stock plugins-cpp recorders; made=$?; cargo build --release --workspace --lib --bins --examples --tests && exit $made'
step vitest npm --prefix web/app run test
start_services || broken+=(services)
step rust tests/setup/rust.py
# What only computes goes beside what waits and measures, and gives way to it, but not to all else on a busy machine (at nice 19 it
# got a twentieth of a CPU); one after the other, because both compile.
meanwhile() { # meanwhile NAME COMMAND...: run it, keep its output and how it ended
  nice -n 5 "${@:2}" > "$logs/beside-$1.log" 2>&1 &
  wait $!
  echo $? > "$logs/beside-$1.code"
}
(
  trap 'kill $(jobs -p); exit 143' TERM
  meanwhile faults tests/oracle-check/faults.py quick
  meanwhile check make -s check
) &
beside=$!
step dist host/dist/test.sh
step python host/python/test.sh
step browser bash -c 'npm --prefix tests/e2e ci --no-audit --no-fund && npm --prefix tests/e2e test'
wait "$beside"
beside=
for name in faults check; do
  step "$name" bash -c 'cat "$1.log"; exit "$(cat "$1.code")"' "$name" "$logs/beside-$name"
done

why "$logs"/{rust,browser}.log
summary "$logs" ${broken[@]+"${broken[@]}"}

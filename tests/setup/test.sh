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
  else
    broken+=("$name")
    echo "== $name: FAILED, $((SECONDS - started)) s"
  fi
}

. tests/setup/services.sh
beside=
trap 'stop_services; [ -z "$beside" ] || kill "$beside" 2>/dev/null || true' EXIT
trap 'exit 130' INT TERM

step build bash -c 'make -s pages stock && cargo build --release --workspace && cargo test --release --workspace --no-run && make -s plugins-cpp'
step vitest npm --prefix web/app run test
start_services || broken+=(services)
step rust cargo test --release --workspace --no-fail-fast
step dist host/dist/test.sh
step faults tests/oracle-check/faults.py quick
# What only compiles goes beside the browser, which mostly waits.
make -s check > "$logs/beside.log" 2>&1 &
beside=$!
step browser bash -c 'npm --prefix tests/e2e ci --no-audit --no-fund && npm --prefix tests/e2e test'
wait "$beside"
step check bash -c 'cat "$1"; exit "$2"' check "$logs/beside.log" $?
beside=

# A test that lacks something on this machine fails with "not run: REASON". These are counted apart, by reason.
reasons=$(sed 's/\x1b\[[0-9;]*m//g' "$logs/rust.log" 2>/dev/null | awk '
  /^ *Running /           { program = $0 }
  /^---- .* stdout ----$/ { name = program " " $2 }
  /^not run: / && name    { sub(/^not run: /, ""); reason[name] = $0 }
  /^failures:$/           { name = "" }
  END                     { for (name in reason) n[reason[name]]++; for (why in n) print n[why] " not run: " why }')
not_run=$(awk '{ n += $1 } END { print n + 0 }' <<< "$reasons")
# A check of the dependencies or of a package that lacks something only says so, and fails nothing.
lacking=$(sed -n 's/^not run: /1 not run: /p' "$logs"/{check,dist}.log 2>/dev/null)

# Each test program says its own counts; a step that broke without a counted failure counts as one.
read -r passed failed < <({ cat "$logs"/{rust,vitest,browser,dist}.log; grep '^deny: ' "$logs/check.log"; } 2>/dev/null | sed 's/\x1b\[[0-9;]*m//g' | awk '
  /^test result:/          { p += $4; f += $6 }
  /^deny: /                { p += $2; f += $4 }
  /^ *Tests  /             { for (i = 2; i <= NF; i++) { if ($i ~ /^passed/) p += $(i - 1); if ($i ~ /^failed/) f += $(i - 1) } }
  /^(#|ℹ) (pass|fail) /    { if ($2 == "pass") p += $3; else f += $3 }
  END                      { print p + 0, f + 0 }')
# A program without a harness, and one that a signal ended, fails without a count of its own.
uncounted=$(sed 's/\x1b\[[0-9;]*m//g' "$logs/rust.log" 2>/dev/null | awk '
  /^test result: FAILED/                     { counted = 1 }
  /^error: (doc)?test failed, to rerun pass/ { n += !counted; counted = 0 }
  END                                        { print n + 0 }')
failed=$((failed - not_run + uncounted))
if [ "$not_run" -gt 0 ]; then
  # The step is broken by nothing else.
  if [ "$failed" -eq 0 ]; then
    kept=()
    for name in "${broken[@]}"; do [ "$name" = rust ] || kept+=("$name"); done
    broken=(${kept[@]+"${kept[@]}"})
  fi
  echo "$reasons"
fi
[ -z "$lacking" ] || echo "$lacking"
if [ ${#broken[@]} -gt 0 ]; then
  echo "test: these steps failed: ${broken[*]} (output in $logs)"
  [ "$failed" -gt 0 ] || failed=${#broken[@]}
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]

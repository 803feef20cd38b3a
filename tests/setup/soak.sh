#!/usr/bin/env bash
# soak.sh MINUTES: first at full size what the tests do in slices: a million files for the jail's gate and a million for the
# readers of objects, ten million messages for the supervisor, a thousand trials, a hundred rounds of honest plugins (OCB_FUZZ,
# OCB_TRIALS, OCB_HONEST), ten measurements of attacks that statistics find (OCB_MEASUREMENTS), the whole of the known sets of
# the bunny (OCB_REAL_INPUT), ten million pairs of triangles for the oracle's filters (OCB_PAIRS), a hundred thousand
# configurations that no certified level of detail may contradict (OCB_HELD_OUT), a hundred runs that end early
# (OCB_REPETITIONS); the service is killed two hundred times (OCB_KILLS), two hundred visitors come for a minute
# (OCB_LOAD_SECONDS), and must not change sixty runs (OCB_LOAD_ROUNDS), every route is asked a hundred times and more
# (OCB_API_EXAMPLES), and an honest visitor goes on beside hostile ones and ten thousand waiting runs for an hour
# (OCB_HOSTILE_MINUTES); a thousand runs are shared by machines that are killed a hundred times (OCB_MACHINE_RUNS,
# OCB_MACHINE_KILLS); two hundred runs of forged plugins, in an hour and a half (OCB_FORGERS), which want a machine with nothing
# else on it; the libraries built for this CPU (`make plugins-native`) answer as they should, and so does all that is portable
# on aarch64 under qemu; systemd runs the units of the Debian package in a virtual machine. Then the restart tests (the service
# is killed at every stage of a run) over and over. The first failure ends it; the last line says how often they passed.
set -euo pipefail
cd "$(dirname "$0")/../.."
minutes=${1:?usage: soak.sh MINUTES}
export OCB_FUZZ=${OCB_FUZZ:-1000000} OCB_TRIALS=${OCB_TRIALS:-1000} OCB_HONEST=${OCB_HONEST:-100}
export OCB_PAIRS=${OCB_PAIRS:-10000000} OCB_REPETITIONS=${OCB_REPETITIONS:-100}
cargo test --release --workspace --test fuzz --test leftovers --test honest_plugins -- --nocapture
OCB_MEASUREMENTS=${OCB_MEASUREMENTS:-10} cargo test --release --workspace --test catalogue -- --nocapture
OCB_REAL_INPUT=${OCB_REAL_INPUT:-1000} cargo test --release --workspace --test real_input
cargo test --release --workspace --lib troublesome_pairs -- --nocapture
cargo test --release --workspace --test early --test early_stopping -- --nocapture
cargo build --release --workspace
tests/setup/tools.sh test
OCB_KILLS=${OCB_KILLS:-200} OCB_LOAD_SECONDS=${OCB_LOAD_SECONDS:-60} OCB_LOAD_ROUNDS=${OCB_LOAD_ROUNDS:-20} \
  OCB_API_EXAMPLES=${OCB_API_EXAMPLES:-100} OCB_HOSTILE_MINUTES=${OCB_HOSTILE_MINUTES:-60} \
  cargo test --release --workspace --test whole -- --nocapture
OCB_MACHINE_RUNS=${OCB_MACHINE_RUNS:-1000} OCB_MACHINE_KILLS=${OCB_MACHINE_KILLS:-100} \
  cargo test --release --workspace --test machines many_runs -- --nocapture
OCB_FORGERS=${OCB_FORGERS:-200} cargo test --release --workspace --test forgers -- --nocapture
meshes=${OCB_SHARED:-../shared}/meshes
target/release/ocb --data "$(mktemp -d)" advise "$meshes/bunny65k.obj" "$meshes/rocker-arm.obj" --held-out "${OCB_HELD_OUT:-100000}"
make -s plugins-native
native=fcl-native,bullet-native,coal-native,parry-native,parry-f32-native
target/release/ocb --json --data "$(mktemp -d)" bench stock:torus-knot@5000 --count 1000 --distance 0.01 --query cd --algorithm "$native" > target/native.json
python3 - target/native.json "$native" <<'CHECK'
import json, sys
rows = {row["algorithm"]: row for row in json.load(open(sys.argv[1]))["results"]}
for name in sys.argv[2].split(","):
    row = rows[name]
    assert row["rank"] and row["wrong"] == 0, (name, row["rank"], row["wrong"])
    sets = {each for build in row["builds"] for each in build["instruction_sets"]}
    assert "AVX" in sets or "AVX2" in sets, (name, sets)
CHECK
npm --prefix tests/e2e ci --no-audit --no-fund && node tests/e2e/every-page.mjs
tests/setup/aarch64.sh all
host/dist/systemd.sh
rounds=0
started=$SECONDS
while [ $((SECONDS - started)) -lt $((minutes * 60)) ]; do
  cargo test --release --workspace --test restart
  rounds=$((rounds + 1))
done
echo "soak: $rounds rounds passed in $(((SECONDS - started) / 60)) min"

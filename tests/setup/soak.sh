#!/usr/bin/env bash
# soak.sh MINUTES: asks the oracle's filters about ten million pairs of triangles (OCB_PAIRS for another number), then runs
# the restart tests (the service is killed at every stage of a run) over and over. The first failure ends it; the last line
# says how often they passed.
set -euo pipefail
cd "$(dirname "$0")/../.."
minutes=${1:?usage: soak.sh MINUTES}
OCB_PAIRS=${OCB_PAIRS:-10000000} cargo test --release --workspace --lib troublesome_pairs -- --nocapture
rounds=0
started=$SECONDS
while [ $((SECONDS - started)) -lt $((minutes * 60)) ]; do
  cargo test --release --workspace --test restart
  rounds=$((rounds + 1))
done
echo "soak: $rounds rounds passed in $(((SECONDS - started) / 60)) min"

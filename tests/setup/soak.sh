#!/usr/bin/env bash
# soak.sh MINUTES: runs the restart tests (the service is killed at every stage of a run) over and over. The first failure
# ends it; the last line says how often they passed.
set -euo pipefail
cd "$(dirname "$0")/../.."
minutes=${1:?usage: soak.sh MINUTES}
rounds=0
while [ $SECONDS -lt $((minutes * 60)) ]; do
  cargo test --release --workspace --test restart
  rounds=$((rounds + 1))
done
echo "soak: $rounds rounds passed in $((SECONDS / 60)) min"

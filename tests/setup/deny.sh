#!/usr/bin/env bash
# Checks all dependencies with cargo-deny and deny.toml: licences, bans, sources and security advisories. The last line counts
# the checks. The database of advisories comes from the network; where it cannot be fetched, a line says "not run: REASON",
# which `make test` counts apart.
set -uo pipefail
cd "$(dirname "$0")/../.."
tests/setup/tools.sh deny || exit 1
deny=(.tools/deny/bin/cargo-deny --workspace --locked)
passed=0 failed=0
for check in licenses bans sources advisories; do
  if [ "$check" = advisories ] && ! timeout 60 "${deny[@]}" fetch db >/dev/null 2>&1; then
    echo "not run: the database of security advisories cannot be fetched"
  elif "${deny[@]}" check --hide-inclusion-graph "$check"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
  fi
done
echo "deny: $passed passed, $failed failed"
[ "$failed" -eq 0 ]

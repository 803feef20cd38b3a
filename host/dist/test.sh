#!/usr/bin/env bash
# Packs what was built, then installs each package in an empty namespace and waits for its first heatmap. Each journey says its
# own counts, which tests/setup/test.sh adds up.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi; }
failed=0
result() { # result NAME STATUS
  if [ "$2" = 0 ]; then echo "$1: ok"; echo "test result: ok. 1 passed; 0 failed"
  else echo "$1: FAILED"; echo "test result: FAILED. 0 passed; 1 failed"; failed=1; fi
}
python3 "$here/pack.py" "$out/one"
result "packing" $?
python3 "$here/pack.py" "$out/two" >/dev/null && diff -r "$out/one" "$out/two"
result "packing again gives the same bytes" $?
journey() { # journey KIND
  local kind=$1 package
  package=$(echo "$out"/one/*"$(case $kind in archive) echo .tar.gz ;; wheel) echo .whl ;; deb) echo .deb ;; esac)")
  as_root timeout 180 unshare --mount --pid --net --ipc --uts --fork --kill-child "$here/empty.sh" "$kind" "$package"
}
# The wheel alone, as its seconds are told; the others together.
journey wheel
result "wheel, from nothing to a heatmap" $?
journey archive > "$out/archive.log" 2>&1 &
archive=$!
if command -v dpkg-deb >/dev/null; then
  journey deb
  result "deb, from nothing to a heatmap" $?
else
  echo "not run: there is no dpkg on this machine"
fi
wait "$archive"
status=$?
cat "$out/archive.log"
result "archive, from nothing to a heatmap" $status
exit $failed

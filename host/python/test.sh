#!/usr/bin/env bash
# The Python package, as `make test` proves it: types by mypy, then the tests with the program that was built, examples and notebook
# included. tests/setup/tools.sh installs what this needs into .tools/python. Each part says its own counts.
set -uo pipefail
cd "$(dirname "$0")"
python=../../.tools/python/bin/python
failed=0
if "$python" -m mypy --cache-dir=/dev/null opencollbench tests; then echo "test result: ok. 1 passed; 0 failed"
else echo "test result: FAILED. 0 passed; 1 failed"; failed=1; fi
PYTHONDONTWRITEBYTECODE=1 "$python" -W error::ResourceWarning tests/run.py "$@" || failed=1
exit $failed

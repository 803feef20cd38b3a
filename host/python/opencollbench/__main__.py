"""The command `ocb`, which lies in this package with its runner, advisor and plugins."""

from __future__ import annotations

import os
import sys


def main() -> None:
    """Replaces this process with the program."""
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ocb")
    if not os.path.isfile(program):
        sys.exit("ocb: This copy of the package has no program; install the wheel that `make dist` builds.")
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()

"""`python -m opencollbench.recorders [--out FOLDER] [--limit N] PROGRAM.py ARGS`: records an unchanged program."""

import argparse
import runpy
import sys

from . import record

parser = argparse.ArgumentParser(prog="python -m opencollbench.recorders", description=__doc__)
parser.add_argument("--out", default="spool", help="folder of the spool [default: spool]")
parser.add_argument("--limit", type=int, default=250_000, help="most queries that are kept [default: 250000]")
parser.add_argument("program", help="Python file")
parser.add_argument("args", nargs=argparse.REMAINDER, help="its arguments")
given = parser.parse_args()
sys.argv = [given.program, *given.args]
sys.path[0] = given.program.rpartition("/")[0]
with record(given.out, limit=given.limit, program=" ".join(sys.argv)):
    runpy.run_path(given.program, run_name="__main__")

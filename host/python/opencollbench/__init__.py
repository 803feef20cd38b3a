"""Benchmarks of collision detection and proximity query algorithms, for speed and accuracy.

>>> import opencollbench
>>> run = opencollbench.bench("stock:torus-knot@600", algorithms=["box-tree"], count=40, passes=1, progress=False)
>>> run.ok
True

The functions call the program `ocb`, which lies in this package, or a `Service`. Nothing else is needed to measure; numpy,
pandas, polars, pyarrow and tqdm are used where they are installed (extras `numpy`, `pandas`, `polars`, `arrow`, `progress`).
"""

from .advice import Advice, advise
from .answers import Answers, truth
from .benchmark import bench
from .command import Command
from .configurations import Configurations, generate
from .errors import Error, MissingPackage, Notice
from .loading import load_run
from .positions import Positions
from .recorders import record
from .reduction import Reduction, reduce_scene
from .run import Run
from .service import Service
from .tables import Parquet, Rows, Table
from .workload import Workload, replay

__all__ = [
    "Advice",
    "Answers",
    "Command",
    "Configurations",
    "Error",
    "MissingPackage",
    "Notice",
    "Parquet",
    "Positions",
    "Reduction",
    "Rows",
    "Run",
    "Service",
    "Table",
    "Workload",
    "advise",
    "bench",
    "generate",
    "load_run",
    "record",
    "reduce_scene",
    "replay",
    "truth",
]

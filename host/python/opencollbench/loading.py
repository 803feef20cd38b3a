"""`load_run`: a run that was measured before."""

from __future__ import annotations

import io
import json
import os
import statistics
import zipfile
from pathlib import Path
from typing import Any, Dict, Optional

from .command import PathLike
from .errors import Error
from .extras import need
from .run import Run
from .service import Service
from .sources import Archive, Folder

#: The verdicts that count as wrong.
WRONG = {"false_negative", "false_positive", "distance_over", "distance_under", "wrong_witness", "invalid"}


def load_run(source: PathLike, *, token: Optional[str] = None) -> Run:
    """Loads a run.

    Args:
        source: a folder that `ocb bench --out` or `bench(out=...)` wrote; the same as a zip file; a repro archive (`ocb run
            repro`, "Repro archive" on a run's page); or the address of a run's page.
        token: for an address, a token of an account there.

    Raises:
        Error: it is none of these.

    >>> kept = bench("stock:torus-knot@600", algorithms="box-tree", count=40, passes=1, out="results", progress=False)
    >>> load_run("results").summary()[0]["n"]
    40
    """
    text = os.fspath(source)
    if text.startswith(("http://", "https://")):
        return from_address(text, token)
    path = Path(text)
    if path.is_dir():
        return Run(parsed((path / "run.json"), read(path / "run.json")), Folder(path))
    if zipfile.is_zipfile(path):
        return from_archive(path)
    raise Error(f"{path} is neither a folder of results, nor a zip archive of a run.")


def from_address(address: str, token: Optional[str]) -> Run:
    before, found, behind = address.partition("/r/")
    if not found:
        before, found, behind = address.partition("/api/v1/runs/")
    run = behind.split("?")[0].split("#")[0].split("/")[0]
    if not found or not run:
        raise Error(f"{address} is not the address of a run, such as http://127.0.0.1:8080/r/ID.")
    return Service(before, token=token).load_run(run)


def from_archive(path: Path) -> Run:
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        if "recipe.json" in names:
            recipe = parsed(path, archive.read("recipe.json"))
            places = {each["id"]: each["answers"] for each in recipe["algorithms"]}
            of = rows_of(archive.read(recipe["configurations"]))
            results = [result_of(id, archive.read(place), of) for id, place in places.items()]
            return Run(info_of(recipe, results, of), Archive(path, places))
        inside = [name for name in names if name == "run.json" or name.endswith("/run.json")]
        if len(inside) != 1:
            raise Error(f"{path} has neither a recipe.json nor one run.json, so it is not an archive of a run.")
        info = parsed(path, archive.read(inside[0]))
        return Run(info, Archive(path, None, inside[0][: -len("run.json")]))


def info_of(recipe: Dict[str, Any], results: Any, of: int) -> Dict[str, Any]:
    """A run as its recipe tells it."""
    return {
        "id": recipe["run"],
        "state": "done",
        "spec": recipe["spec"],
        "environment": recipe["environment"],
        "set": {"configurations": of},
        "results": results,
    }


def rows_of(configurations: bytes) -> int:
    parquet = need("pyarrow.parquet", "A repro archive", "arrow")
    return int(parquet.ParquetFile(io.BytesIO(configurations)).metadata.num_rows)


def result_of(algorithm: str, records: bytes, of: int) -> Dict[str, Any]:
    """What the records say of an algorithm: a repro archive has no summary, ratios, ranks or outcomes."""
    parquet = need("pyarrow.parquet", "A repro archive", "arrow")
    table = parquet.read_table(io.BytesIO(records), columns=["time_ns", "verdict"])
    times, verdicts = table["time_ns"].to_pylist(), table["verdict"].to_pylist()
    result: Dict[str, Any] = {"algorithm": algorithm, "n": len(times), "of": of}
    result["verdicts"] = [{"verdict": each, "count": verdicts.count(each)} for each in sorted(set(verdicts))]
    result["wrong"] = sum(verdict in WRONG for verdict in verdicts)
    if times:
        values = {"median_ns": statistics.median(times), "mean_ns": statistics.fmean(times), "max_ns": max(times)}
        result["time"] = {name: {"value": value} for name, value in values.items()}
    return result


def read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise Error(f"{path} is missing, so its folder has no results of a run.") from None


def parsed(path: Path, content: bytes) -> Dict[str, Any]:
    try:
        data: Dict[str, Any] = json.loads(content)
    except ValueError as error:
        raise Error(f"{path} cannot be read: {error}.") from None
    return data

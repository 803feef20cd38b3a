"""Tables of results, for pandas, polars, Arrow, or as plain rows."""

from __future__ import annotations

import io
from abc import ABC, abstractmethod
from importlib import import_module
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Mapping, Sequence, Tuple

from .errors import Error
from .extras import either, need

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import polars
    import pyarrow
    from numpy.typing import NDArray

#: A row: values by the names of their columns.
Row = Dict[str, Any]


class Table(ABC):
    """A table of results."""

    @abstractmethod
    def to_arrow(self) -> "pyarrow.Table":
        """As a `pyarrow.Table` (extra `arrow`)."""

    @abstractmethod
    def to_polars(self) -> "polars.DataFrame":
        """As a `polars.DataFrame` (extra `polars`)."""

    def to_pandas(self) -> "pandas.DataFrame":
        """As a `pandas.DataFrame` (extra `pandas`)."""
        need("pandas", "A data frame of pandas", "pandas")
        frame: "pandas.DataFrame" = self.to_arrow().to_pandas()
        return frame


class Rows(Table, Sequence[Row]):
    """A table whose rows are here, so that it can be read without any other package."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self._rows = list(rows)

    def __getitem__(self, index: Any) -> Any:
        return self._rows[index]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self._rows)

    def to_arrow(self) -> "pyarrow.Table":
        return need("pyarrow", "An Arrow table", "arrow").Table.from_pylist(self._rows)

    def to_polars(self) -> "polars.DataFrame":
        frame: "polars.DataFrame" = need("polars", "A data frame of polars", "polars").DataFrame(
            self._rows, infer_schema_length=None
        )
        return frame

    def to_pandas(self) -> "pandas.DataFrame":
        frame: "pandas.DataFrame" = need("pandas", "A data frame of pandas", "pandas").DataFrame(self._rows)
        return frame

    def __str__(self) -> str:
        """As text, one line per row."""
        if not self._rows:
            return "(no rows)"
        names = list(self._rows[0])
        lines = [names] + [[worded(row.get(name)) for name in names] for row in self._rows]
        widths = [max(len(line[i]) for line in lines) for i in range(len(names))]
        return "\n".join("  ".join(word.ljust(width) for word, width in zip(line, widths)).rstrip() for line in lines)


class Parquet(Table):
    """A table in one or more Parquet files, read when it is asked for.

    Args:
        parts: of each file, columns with one value to put in front of its own, and what gives its bytes.
    """

    def __init__(self, parts: Sequence[Tuple[Mapping[str, Any], Callable[[], bytes]]]) -> None:
        self._parts = list(parts)

    def to_arrow(self) -> "pyarrow.Table":
        arrow = need("pyarrow", "An Arrow table", "arrow")
        parquet = need("pyarrow.parquet", "An Arrow table", "arrow")
        tables = []
        for constants, read in self._parts:
            table = parquet.read_table(io.BytesIO(read()))
            for place, (name, value) in enumerate(constants.items()):
                table = table.add_column(place, name, arrow.array([value] * table.num_rows))
            tables.append(table)
        return tables[0] if len(tables) == 1 else arrow.concat_tables(tables, promote_options="default")

    def to_polars(self) -> "polars.DataFrame":
        library = need("polars", "A data frame of polars", "polars")
        frames = []
        for constants, read in self._parts:
            frame = polars_frame(library, read())
            fixed = [library.lit(value).alias(name) for name, value in constants.items()]
            frames.append(frame.select(*fixed, library.all()))
        whole: "polars.DataFrame" = library.concat(frames, how="diagonal")
        return whole

    def matrices(self, *columns: str) -> "List[NDArray[np.float64]]":
        """Columns of lists of equal length, each as an array (extra `numpy`, and `arrow` or `polars`).

        Raises:
            Error: there is no such column.
        """
        need("numpy", "An array", "numpy")
        library = either(["pyarrow", "polars"], "An array from a Parquet file", "arrow")
        if library.__name__ == "pyarrow":
            table = self.to_arrow()
            found: List[Any] = [table[present(column, table.column_names)].combine_chunks() for column in columns]
            flat = [each.flatten().to_numpy(zero_copy_only=False) for each in found]
            return [each.reshape(table.num_rows, -1) for each in flat]
        frame = self.to_polars()
        series: List[Any] = [frame[present(column, frame.columns)].explode() for column in columns]
        return [each.to_numpy().reshape(len(frame), -1) for each in series]


def polars_frame(polars: Any, content: bytes) -> Any:
    """Reads a Parquet file. Before version 1.43 polars refuses those that name the total order of floating-point numbers."""
    try:
        return polars.read_parquet(io.BytesIO(content))
    except polars.exceptions.ComputeError:
        try:
            parquet = import_module("pyarrow.parquet")
        except ImportError:
            version = polars.__version__
            raise Error(f"polars {version} cannot read this Parquet file; install polars 1.43 or newer, or pyarrow.") from None
        return polars.from_arrow(parquet.read_table(io.BytesIO(content)))


def present(column: str, names: Sequence[str]) -> str:
    if column not in names:
        raise Error(f"There is no column {column!r}; the columns are {', '.join(names)}.")
    return column


def joined(tables: Sequence[Parquet]) -> Parquet:
    """The rows of several tables below each other; columns that some lack are empty there."""
    return Parquet([part for table in tables for part in table._parts])


def worded(value: Any) -> str:
    """A value as text, numbers with four digits that count."""
    if value is None:
        return "-"
    if isinstance(value, float):
        return f"{value:.4g}"
    return str(value)


def picked(data: Mapping[str, Any], *names: str) -> Any:
    """A value inside of nested JSON objects, or nothing where a part is absent."""
    found: Any = data
    for name in names:
        if not isinstance(found, Mapping):
            return None
        found = found.get(name)
    return found

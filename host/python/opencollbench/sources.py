"""Where the files of a run are: a folder, or a zip archive."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any, Mapping, Optional

from .errors import Error


class Folder:
    """The folder that `ocb bench --out` writes.

    Args:
        path: the folder.
        kept: what deletes it when nothing needs it any more.
    """

    def __init__(self, path: Path, kept: Any = None) -> None:
        self.path = path
        self._kept = kept

    def records(self, algorithm: str) -> bytes:
        return self._content(f"{algorithm}.parquet")

    def triangles(self, algorithm: str) -> Optional[bytes]:
        path = self.path / f"{algorithm}.triangles.parquet"
        return path.read_bytes() if path.is_file() else None

    def configurations(self) -> bytes:
        return self._content("configurations.parquet")

    def _content(self, name: str) -> bytes:
        try:
            return (self.path / name).read_bytes()
        except FileNotFoundError:
            raise Error(f"{self.path / name} is missing.") from None


class Archive:
    """A zip archive: a repro archive of a run, or a folder of `ocb bench --out` that was packed.

    Args:
        path: the file.
        places: in a repro archive, the file with the answers of each algorithm; else absent.
    """

    def __init__(self, path: Path, places: Optional[Mapping[str, str]], below: str = "") -> None:
        self.path = path
        self._places = places
        self._below = below

    def records(self, algorithm: str) -> bytes:
        name = f"{self._below}{algorithm}.parquet" if self._places is None else self._places[algorithm]
        return self._content(name)

    def triangles(self, algorithm: str) -> Optional[bytes]:
        try:
            return None if self._places is not None else self._content(f"{self._below}{algorithm}.triangles.parquet")
        except Error:
            return None

    def configurations(self) -> bytes:
        return self._content(f"{self._below}configurations.parquet")

    def _content(self, name: str) -> bytes:
        with zipfile.ZipFile(self.path) as archive:
            try:
                return archive.read(name)
            except KeyError:
                raise Error(f"{self.path} has no file {name}.") from None

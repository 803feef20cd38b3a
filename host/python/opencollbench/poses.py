"""Poses of object B in the frame of object A, as arrays and as files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from .errors import Error
from .extras import need

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from .configurations import Configurations

#: Poses of B in A's frame: an array (n, 4, 4) or (n, 3, 4) of matrices, one such matrix, a file as `ocb bench --configurations`
#: reads it, or what `generate` gave.
Poses = Union["ArrayLike", "os.PathLike[str]", str, "Configurations"]


def matrices(poses: Any) -> "NDArray[np.float64]":
    """The poses as an array (n, 4, 4).

    Raises:
        Error: it is no array of matrices.
    """
    numpy = need("numpy", "An array of poses", "numpy")
    try:
        given = numpy.asarray(poses, dtype=numpy.float64)
    except (TypeError, ValueError):
        raise Error("Poses must be numbers in an array of shape (n, 4, 4) or (n, 3, 4).") from None
    if given.ndim == 2:
        given = given[None]
    if given.ndim != 3 or given.shape[1:] not in ((4, 4), (3, 4)):
        raise Error(f"Poses must be an array of shape (n, 4, 4) or (n, 3, 4), not {numpy.shape(poses)}.")
    whole = numpy.tile(numpy.eye(4), (len(given), 1, 1))
    whole[:, : given.shape[1]] = given
    last = numpy.flatnonzero((whole[:, 3] != [0, 0, 0, 1]).any(axis=1))
    if len(last):
        raise Error(f"The last row of pose {last[0]} must be 0 0 0 1; matrices multiply column vectors.")
    answer: "NDArray[np.float64]" = whole
    return answer


def filed(poses: Any, folder: Path) -> Path:
    """The poses as a file; an array is written to `folder`, in double precision."""
    from .configurations import Configurations

    if isinstance(poses, Configurations):
        return poses.file(folder)
    if isinstance(poses, (str, os.PathLike)):
        return Path(poses)
    path = folder / "poses.f64"
    path.write_bytes(matrices(poses).astype("<f8").tobytes())
    return path


def relative(pose_a: Any, pose_b: Any) -> "NDArray[np.float64]":
    """B in A's frame, of two arrays (n, 12) of matrices to the world without their last rows."""
    first, second = (matrices(each.reshape(-1, 3, 4)) for each in (pose_a, pose_b))
    numpy = need("numpy", "An array of poses", "numpy")
    if (first == numpy.eye(4)).all():
        return second
    answer: "NDArray[np.float64]" = numpy.linalg.inv(first) @ second
    return answer

"""What goes wrong, each as one sentence."""

from __future__ import annotations

from typing import Optional


class Error(Exception):
    """The command or the service refused, or failed.

    The text is its one sentence: the fault, the place, and how to mend it.

    Attributes:
        code: exit code of the command, or HTTP status of the service; absent where neither was reached.
    """

    def __init__(self, sentence: str, code: Optional[int] = None) -> None:
        super().__init__(sentence)
        self.code = code


class MissingPackage(Error, ImportError):
    """A Python package that an optional part of this one needs is not installed."""


class Notice(UserWarning):
    """Something that the command says beside its result, such as what it mended in a file."""

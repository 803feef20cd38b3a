"""Packages that only some functions need: imported when one of those is called."""

from __future__ import annotations

from importlib import import_module
from typing import Any, Sequence

from .errors import MissingPackage


def need(package: str, purpose: str, extra: str) -> Any:
    """Imports a package.

    Args:
        package: name of the package.
        purpose: what it is needed for, as the subject of a sentence.
        extra: the extra of this package that installs it.

    Raises:
        MissingPackage: it is not installed.
    """
    return either([package], purpose, extra)


def either(packages: Sequence[str], purpose: str, extra: str) -> Any:
    """Imports the first of these packages that is installed; like `need` otherwise."""
    for package in packages:
        try:
            return import_module(package)
        except ImportError:
            continue
    named = " or ".join(packages)
    raise MissingPackage(f"{purpose} needs {named}; install it with: pip install 'opencollbench[{extra}]'")

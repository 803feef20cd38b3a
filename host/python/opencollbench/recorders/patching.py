"""Puts recording functions into libraries: into those that are loaded, and into others when the program imports them."""

import ctypes
import importlib
import importlib.abc
import os
import sys

#: The module that patches each library.
LIBRARIES = {"fcl": "on_fcl", "coal": "on_coal", "mujoco": "on_mujoco"}
_undo, _at_first = [], None


def replace(modules, name, new):
    """Puts `new` in the place of an attribute of modules; what to put back."""
    undo = [(module, name, getattr(module, name)) for module in modules if hasattr(module, name)]
    for module, *_ in undo:
        setattr(module, name, new)
    return undo


def leave(library, module):
    """Tells the recorder that `ocb record` loaded for a C++ library that calls from this module are recorded here."""
    leave = getattr(ctypes.CDLL(None), f"ocb_record_leave_{library}", None)
    if leave:
        leave(os.fsencode(module.__file__))


def install(at_first=None):
    """Patches every library, now or when it is imported; calls `at_first` before the first."""
    global _at_first
    _at_first = at_first
    for name in LIBRARIES:
        if name in sys.modules:
            _patch(sys.modules[name])
    sys.meta_path.insert(0, _Finder())


def remove():
    """Puts everything back."""
    sys.meta_path[:] = [finder for finder in sys.meta_path if not isinstance(finder, _Finder)]
    while _undo:
        setattr(*_undo.pop())


def _patch(library):
    global _at_first
    try:
        if _at_first:
            _at_first, begin = None, _at_first
            begin()
        module = importlib.import_module(f"{__package__}.{LIBRARIES[library.__name__]}")
        _undo.extend(module.patch(library))
    except Exception as error:  # A recorder must not end the program that it records.
        print(f"opencollbench: {library.__name__} is not recorded: {error!r}", file=sys.stderr)


class _Finder(importlib.abc.MetaPathFinder):
    """Lets the usual finders find a library, and patches it when it has been loaded."""

    def find_spec(self, name, path, target=None):
        if name not in LIBRARIES:
            return None
        for finder in sys.meta_path:
            find = None if isinstance(finder, _Finder) else getattr(finder, "find_spec", None)
            spec = find and find(name, path, target)
            if spec and spec.loader:
                spec.loader = _Loader(spec.loader)
                return spec
        return None


class _Loader(importlib.abc.Loader):
    """Loads as the loader that it stands for."""

    def __init__(self, loader):
        self.loader = loader

    def __getattr__(self, name):
        return getattr(self.loader, name)

    def create_module(self, spec):
        return self.loader.create_module(spec)

    def exec_module(self, module):
        # The library sees its own loader.
        module.__loader__ = module.__spec__.loader = self.loader
        self.loader.exec_module(module)
        _patch(module)

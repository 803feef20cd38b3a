"""The objects of a library in the spool that is being written, so that each model is read once."""

import functools

from . import session

#: The fields of primitives in a spool.
_FIELDS = {"box": ["size"], "sphere": ["radius"], "cylinder": ["radius", "length"], "capsule": ["radius", "length"]}
#: Characters of a name that are kept.
_LONGEST_NAME = 200
#: The reason for convex bodies: an object may be inside of them, which their surface does not tell.
_SURFACE = "its surface; the program's answers where it collides are left out"


def named(geometry):
    """What the program calls a geometry: its attribute `name`, or nothing."""
    name = getattr(geometry, "name", None)
    return name[:_LONGEST_NAME] if isinstance(name, str) else ""


class Shapes:
    """Numbers of objects in a spool, by what tells them apart."""

    def __init__(self, library):
        """`library` is a name and a version."""
        self.library = library
        self._known, self._spool = {}, None

    def mesh(self, spool, mark, read, name=""):
        """A mesh with this mark; `read` gives vertices and triangles. Without a name it is called by its kind."""
        return self._object(spool, (mark, name), lambda: self._model(spool, "mesh", read(), "", name))

    def convex(self, spool, mark, read, name=""):
        """A convex body with this mark."""
        return self._object(spool, (mark, name), lambda: self._model(spool, "convex body", read(), _SURFACE, name))

    def primitive(self, spool, kind, *sizes, name=""):
        """A box (three edges), sphere (radius), cylinder or capsule (radius, length)."""
        values = [sizes] if kind == "box" else sizes
        shape = {"kind": kind} | dict(zip(_FIELDS[kind], values))
        return self._object(spool, (kind, *sizes, name), lambda: spool.object(name or kind, shape, self.library))

    def _model(self, spool, what, model, source, name):
        name = name or f"{what} of {len(model[1])} triangles"
        return spool.object(name, model, self.library, source)

    def _object(self, spool, mark, make):
        if spool is not self._spool:
            self._known, self._spool = {}, spool
        if mark not in self._known:
            self._known[mark] = make()
        return self._known[mark]


def recording(function, describer):
    """A function that asks `function` and records it; `describer(args, kwargs)` is called before and gives what `observe` needs."""

    @functools.wraps(function)
    def recorded(*args, **kwargs):
        return session.observe(lambda: function(*args, **kwargs), describer(args, kwargs))

    return recorded

"""The recording that is under way in this process, and the group to which a query belongs."""

import itertools
import os
import sys
import threading
import time
from contextlib import contextmanager

from .spool import Spool, Unusable

#: The spool that is written; none when nothing is recorded.
active = None
#: Makes the spool of a process when it asks its first query; none when nothing is recorded.
_make = None
_numbers = itertools.count()
_here = threading.local()


def begin(make):
    """Queries are recorded from now on, in the spool that `make` makes at the first of them."""
    global _make
    _make = make


def end():
    """Nothing is recorded any more."""
    global active, _make
    spool, active, _make = active, None, None
    if spool:
        with spool.lock:
            spool.close()


def recording():
    """Is anything recorded?"""
    return _make is not None


def group():
    """Begins a group of this thread."""
    _here.group = next(_numbers)


@contextmanager
def together():
    """The queries of this thread inside belong to one group, unless the program names its groups itself."""
    if getattr(_here, "group", None) is not None:
        yield
        return
    _here.group = next(_numbers)
    try:
        yield
    finally:
        _here.group = None


def observe(ask, describe):
    """Asks the library and records it; gives its very answer.

    `ask` calls the library. `describe(spool, answer)` gives objects, poses, kind, bits, limit and distance, or raises
    `Unusable` with the reason why the query cannot be recorded.
    """
    if _make is None or getattr(_here, "inside", False):
        return ask()
    _here.inside = True
    failed = "the library reported an error"
    answer = seconds = None
    try:
        begun = time.perf_counter_ns()
        answer = ask()
        seconds = (time.perf_counter_ns() - begun) * 1e-9
        failed = None
    finally:
        try:
            _record(describe, answer, seconds, failed)
        except Exception as error:  # A recorder must not end the program that it records.
            _give_up(error)
        finally:
            _here.inside = False
    return answer


def _give_up(error):
    global active, _make
    active = _make = None
    print(f"opencollbench: recording stopped, what was written stays: {error}", file=sys.stderr)


def missed(reason):
    """Counts a query of a kind that is not recorded."""

    def describe(_spool, _answer):
        raise Unusable(reason)

    return describe


def _record(describe, answer, seconds, failed):
    global active
    if active is None:
        active = _make()
    spool = active
    with spool.lock:
        group = getattr(_here, "group", None)
        group = next(_numbers) if group is None else group
        if not spool.keeps(group):
            return
        try:
            if failed:
                raise Unusable(failed)
            objects, poses, kind, bits, limit, distance = describe(spool, answer)
        except Unusable as why:
            spool.drop(str(why))
        except OSError:
            raise
        except Exception as error:
            spool.drop(f"the recorder failed ({type(error).__name__})")
        else:
            spool.query(group, objects, poses, kind, bits, limit, distance, seconds)


def new_process(make):
    """After a fork the child writes a spool of its own, or none."""
    global active, _make
    if _make is not None:
        active, _make = None, make()


def each_process(folder, program, limit):
    """Begins recording in spools below `folder`, one for each process, also for those that this one forks."""

    def make():
        for number in itertools.count():
            try:
                return Spool(f"{folder}/{os.getpid()}-python-{number}", program, limit)
            except FileExistsError:
                continue

    begin(make)
    os.register_at_fork(after_in_child=lambda: new_process(lambda: make))


def this_process(folder, program, limit):
    """Begins recording in this folder; children of a fork are not recorded."""
    spool = Spool(folder, program, limit)
    begin(lambda: spool)
    os.register_at_fork(after_in_child=lambda: new_process(lambda: None))

"""The two accesses whose order made nodes fail: which function read what before which one wrote it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from sim.evidence import Recording
from sim.evidence.failure import frames_of
from sim.ros.engine.access_log import AccessLog, Gap, Logged
from sim.ros.engine.points import CALL, READ, WRITE

SOON = 20  # accesses of a thread before and after its preemption that can belong to a race


def race(usual: AccessLog, other: AccessLog, failed: Recording) -> str:
    """Describe the accesses that came in another order than usual; "" if none did."""
    found = (_in_preemption(other, gap) for gap in reversed(other.gaps))
    return next(filter(None, found), "") or _read_too_early(usual, other, failed)


# -- threads -----------------------------------------------------------------------------------------


def _in_preemption(log: AccessLog, gap: Gap) -> str:
    """Describe what happened in a preemption to something that the thread used before or after it."""
    end = len(log.accesses) if gap.end is None else gap.end
    before = [each for each in log.accesses[: gap.begin] if each.thread == gap.thread][: -SOON - 1 : -1]
    after = [each for each in log.accesses[end:] if each.thread == gap.thread][:SOON]
    after = gap.planned if gap.end is None else after
    meanwhile = log.accesses[gap.begin : end][::-1]
    here = {gap.function, *(each.function for each in after[:1])}  # a line that calls another one is in both
    for early in before:
        if early.function in here:
            later = next((each for each in after if each.what == early.what and each.kind != READ), None)
            changed = _conflicting(meanwhile, early, later)
            if changed is not None:
                return _stale(early, changed, later)
    for late in after:
        changed = _conflicting(meanwhile, late, late)
        if changed is not None:
            return f"{_does(changed, late)} before `{late.function}` {_did(late)}."
    return ""


def _conflicting(meanwhile: Sequence[Logged], use: Logged, later: Logged | None) -> Logged | None:
    """The access of another thread that collides with this use: one of both changes something."""
    same = [each for each in meanwhile if each.what == use.what and each.thread != use.thread]
    changing = [each for each in same if each.kind != READ]
    if changing:
        return changing[0]
    return same[0] if same and later is not None and later.kind != READ else None


def _stale(early: Logged, changed: Logged, later: Logged | None) -> str:
    text = f"`{early.function}` {_did(early)} before {_does(changed, early)}"
    return f"{text}, and then `{early.function}` {_did(later)}." if later is not None else f"{text}."


def _does(access: Logged, use: Logged) -> str:
    other = " in another thread" if access.function == use.function else ""
    return f"`{access.function}`{other} {_did(access)}"


# -- callbacks ---------------------------------------------------------------------------------------


def _read_too_early(usual: AccessLog, other: AccessLog, failed: Recording) -> str:
    """Describe a read that has another value than in the usual order, and the write that comes after it."""
    usually = {key: (place, read) for key, place, read in _reads(usual)}
    different = [
        item for item in _reads(other) if item[0] in usually and usually[item[0]][1].value != item[2].value
    ]
    if not different:
        return ""
    failing = {name for error in failed.errors for _, _, name in frames_of(error)}
    begin = min((departure.stamp for departure in failed.departures), default=0.0)
    late = [item for item in different if item[2].stamp >= begin] or different
    at_fault = (item for item in reversed(late) if item[2].function.rpartition(".")[2] in failing)
    key, index, read = next(at_fault, late[0])
    place, there = usually[key]
    earlier = [each for each in reversed(usual.accesses[:place]) if each.what == there.what]
    later = [each for each in other.accesses[index + 1 :] if each.what == read.what]
    writes = (each for each in [*later, *earlier] if each.kind == WRITE and each.function != read.function)
    write = next(writes, None)
    before = "" if write is None else f" before `{write.function}` {_did(write)}"
    return f"`{read.function}` {_did(read)}{before}; in the usual order it reads {there.value} there."


def _reads(log: AccessLog) -> Iterator[tuple[tuple[object, ...], int, Logged]]:
    """Each read with its place in the log, and a key by which the same one is found in another log."""
    count: Counter[tuple[object, ...]] = Counter()
    for index, access in enumerate(log.accesses):
        if access.kind == READ:
            key = access.function, access.line, access.owner, access.name
            count[key] += 1
            yield (*key, count[key]), index, access


def _did(access: Logged) -> str:
    """Return what an access was, such as "reads Counter.count = 3 (line 12)"."""
    name = ".".join(filter(None, (access.owner, access.name)))
    if access.kind == CALL:
        return f"calls {name}.{access.value} (line {access.line})"
    value = f" = {access.value}" if access.value else ""
    return f"{access.kind} {name}{value} (line {access.line})"

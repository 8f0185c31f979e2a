"""Measures over services: who offers them, who asks, and whether the answers come and are right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from grader.checks.check import Missed
from grader.checks.ends import declared
from grader.checks.fields import differing, read, told, words
from grader.checks.no_data import no_data
from sim.evidence import Call, Endpoint, Recording, Seconds


def serves(recording: Recording, service: str, type: str = "") -> list[Endpoint]:
    """The servers of a service, e.g. "/add" of type "example_interfaces/srv/AddTwoInts".

    Raises Missed when there is none, or one of another type.
    """
    expected = f"a service {service}" + (f" of type {type}" if type else "")
    return declared(recording, "service", service, type, expected)


def calls(recording: Recording, service: str, type: str = "", *, at_least: int = 1) -> list[Call]:
    """The student's calls of a service, at least so many.

    Raises Missed when client, type or calls are not there.
    """
    expected = f"a client for {service}" + (f" of type {type}" if type else "")
    declared(recording, "client", service, type, expected)
    asked = [call for call in recording.calls_of(service) if call.requested is not None]
    found = [call for call in asked if not call.requested_by_course]
    if len(found) < at_least:
        many = f"a call of {service}" if at_least == 1 else f"{at_least} or more calls of {service}"
        saw = f"only {len(found)} in {recording.ended.stamp:.3g} s" if found else "a client, but no call"
        raise Missed(many, saw)
    return found


def responds(
    recording: Recording,
    service: str,
    right: Callable[[Any], Mapping[str, Any]] = lambda request: {},
    *,
    within: Seconds = 0.5,
    where: Callable[[Call], bool] = lambda call: True,
) -> list[Call]:
    """Every call is answered in time and with the right fields; partial credit for those that are.

    right: gives the fields of the right response and their values for a request, such as
    `lambda request: {"sum": request.a + request.b}`; other fields may be anything.
    where: picks the calls that are judged.
    Raises Missed for the first that is not, and when nobody offers the service; without calls as `no_data`.
    """
    asked = [call for call in recording.calls_of(service) if where(call) and _due(recording, call, within)]
    if not asked:
        serves(recording, service)
        saw = f"{len(recording.calls_of(service))}, and none of them is one"
        raise no_data(
            recording, f"calls of {service} that want an answer", saw, recording.graph.ends("client", service)
        )
    misses = [miss for call in asked if (miss := _miss(call, right, within))]
    if misses:
        raise Missed(*misses[0], credit=1 - len(misses) / len(asked))
    return asked


def _due(recording: Recording, call: Call, within: Seconds) -> bool:
    """Whether the answer should have come before the end of the run."""
    return call.answered is not None or _began(call) + within <= recording.ended.stamp


def _began(call: Call) -> Seconds:
    return call.taken or 0.0 if call.requested is None else call.requested


def _miss(call: Call, right: Callable[[Any], Mapping[str, Any]], within: Seconds) -> tuple[str, str] | None:
    """What was expected of an answer and what was seen, for one that isn't as it should be."""
    if call.answered is None or call.answered - _began(call) > within:
        return f"an answer to {question(call)} within {within:g} s", _no_answer(call)
    values = right(call.request)
    wrong = differing(call.response, values)
    if not wrong:
        return None
    saw = ", ".join(f"{name}={read(call.response, name)!r}" for name in wrong)
    return f"{words({name: values[name] for name in wrong})} as the answer to {question(call)}", saw


def _no_answer(call: Call) -> str:
    if call.answered is not None:
        return f"an answer after {call.answered - _began(call):.3g} s"
    if call.raised:
        return f"the callback raised {call.raised}"
    return "no answer" if call.taken is not None else "nobody took the request"


def question(call: Call) -> str:
    """A call in words: "/arm (data=True) at 1.5 s"."""
    text = told(call.request)
    return f"{call.service}{f' ({text})' if text else ''} at {_began(call):.3g} s"

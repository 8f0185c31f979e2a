"""Measures over services: servers, clients, and whether responses come and are right."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from grader.checks.check import Missed, hinting
from grader.checks.ends import declared
from grader.checks.fields import differing, message_text, plain, read, words
from grader.checks.no_data import no_data
from sim.evidence import Call, Endpoint, Goal, Recording, Seconds

STUCK = (
    "The service's callback hasn't returned: it waits, or is stuck in a loop. Let it store the request in "
    "self, and return the response at once."
)


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
    Raises Missed for the first that is not, and when no node offers the service; without calls as `no_data`.
    """
    asked = [call for call in recording.calls_of(service) if where(call) and _due(recording, call, within)]
    if not asked:
        serves(recording, service)
        saw = f"{len(recording.calls_of(service))}, but none like that"
        raise no_data(
            recording,
            f"calls of {service} that should get a response",
            saw,
            recording.graph.ends("client", service),
        )
    misses = [miss for call in asked if (miss := _miss(call, right, within))]
    if misses:
        raise Missed(*misses[0], credit=1 - len(misses) / len(asked))
    return asked


def _due(recording: Recording, call: Call, within: Seconds) -> bool:
    """Return whether the answer should have come before the end of the run."""
    return call.answered is not None or _began(call) + within <= recording.ended.stamp


def _began(call: Call) -> Seconds:
    return call.taken or 0.0 if call.requested is None else call.requested


def _miss(call: Call, right: Callable[[Any], Mapping[str, Any]], within: Seconds) -> tuple[str, str] | None:
    """Return what was expected of an answer and what was seen, for one that isn't as it should be."""
    if call.answered is None or call.answered - _began(call) > within:
        return f"an answer to {call_text(call)} within {within:g} s", _no_answer(call)
    values = right(call.request)
    wrong = differing(call.response, values)
    if not wrong:
        return None
    saw = ", ".join(f"{name}={read(call.response, name)!r}" for name in wrong)
    return f"{words({name: values[name] for name in wrong})} as the answer to {call_text(call)}", saw


def _no_answer(call: Call) -> str:
    if call.answered is not None:
        return f"an answer after {call.answered - _began(call):.3g} s"
    if call.raised:
        return f"the callback raised {call.raised}"
    return "no answer" if call.taken is not None else "no server received the request"


def sent_at(request: Call | Goal) -> Seconds:
    """Return when a client sent a request; for those of which that is known, such as the course's."""
    assert request.requested is not None, "no client here sent it"
    return request.requested


def call_text(call: Call) -> str:
    """Return a call as text: "/arm (data=True) at 1.5 s"."""
    text = message_text(call.request)
    return f"{call.service}{f' ({text})' if text else ''} at {_began(call):.3g} s"


def course_calls(run: Recording, service: str, at_least: int = 1) -> list[Call]:
    """The course's calls of a service. Raises Missed when the run ended before there were so many."""
    made = [call for call in run.calls_of(service) if call.requested_by_course]
    if len(made) < at_least:
        expected = f"a run that lasts until {service} is called"
        raise Missed(expected if at_least == 1 else f"{expected} {at_least} times", run.ended.detail)
    return made


def offers(run: Recording, service: str, type: str) -> None:
    """A node offers a service of this type. Raises Missed with what is offered instead."""
    name = type.rsplit("/", 1)[-1]
    with hinting(f'self.create_service({name}, "{service}", self.callback) creates one.'):
        serves(run, service, type)


def has_client(run: Recording, service: str, type: str) -> list[Call]:
    """The calls that clients of a service made, if any. Raises Missed without a client of this type."""
    name = type.rsplit("/", 1)[-1]
    with hinting(f'self.client = self.create_client({name}, "{service}") creates one.'):
        declared(run, "client", service, type, f"a client for {service} of type {type}")
    return [call for call in run.calls_of(service) if call.requested is not None]


def response_fields(call: Call) -> dict[str, Any]:
    """Return the fields of the response, as `plain` gives them; {} without one."""
    return {} if call.response is None else plain(call.response)


def is_success(call: Call) -> bool:
    """Return whether the response says success."""
    fields = response_fields(call)
    return bool(fields.get("success", fields.get("successful")))


def is_refusal(call: Call) -> bool:
    """Return whether the response says that it refuses. Without a response it is neither."""
    return call.response is not None and not is_success(call)


def wrong_response(expected: str, call: Call, guess: str = "", *, credit: float = 0.0) -> Missed:
    """Return what to raise for a call with another response than expected, or with none."""
    stuck = call.taken is not None and call.answered is None
    saw = words(response_fields(call)) or "no answer"
    return Missed(expected, saw, STUCK if stuck else "", guess=guess, credit=credit, about=(call,))

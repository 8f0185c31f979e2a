"""Calls as evidence: what was asked of the student's services, and whether the answer was yes."""

from __future__ import annotations

from typing import Any

from grader.checks import Missed, hinting, serves
from grader.checks.ends import declared
from grader.checks.fields import plain, words
from sim.evidence import Call, Recording

STUCK = (
    "The callback of the service has not come back: it waits, or goes round in a loop. Let it note "
    "in self what is wanted, and return the response at once."
)


def our_calls(run: Recording, service: str, at_least: int = 1) -> list[Call]:
    """The calls of a service by ours. Raises Missed when the run ended before so many of ours were made."""
    made = [call for call in run.calls_of(service) if call.requested_by_course]
    if len(made) < at_least:
        expected = f"a run that lasts until {service} is called"
        raise Missed(expected if at_least == 1 else f"{expected} {at_least} times", run.ended.detail)
    return made


def offers(run: Recording, service: str, type: str) -> None:
    """Somebody offers a service of this type. Raises Missed with what is offered in its place."""
    name = type.rsplit("/", 1)[-1]
    with hinting(f'self.create_service({name}, "{service}", self.callback) offers one.'):
        serves(run, service, type)


def has_client(run: Recording, service: str, type: str) -> list[Call]:
    """The calls that clients of a service made, if any. Raises Missed with the clients that there are."""
    name = type.rsplit("/", 1)[-1]
    with hinting(f'self.client = self.create_client({name}, "{service}") makes one.'):
        declared(run, "client", service, type, f"a client for {service} of type {type}")
    return [call for call in run.calls_of(service) if call.requested is not None]


def answer(call: Call) -> dict[str, Any]:
    """The fields of the response, as `plain` gives them; {} without one."""
    return {} if call.response is None else plain(call.response)


def accepted(call: Call) -> bool:
    """Was the answer yes?"""
    fields = answer(call)
    return bool(fields.get("success", fields.get("successful")))


def refused(call: Call) -> bool:
    """Was the answer no? Without any answer it was neither."""
    return call.response is not None and not accepted(call)


def wrong_answer(expected: str, call: Call, guess: str = "", *, credit: float = 0.0) -> Missed:
    """What to raise for a call that was answered otherwise than expected, or not at all."""
    stuck = call.taken is not None and call.answered is None
    said = words(answer(call)) or "no answer"
    return Missed(expected, said, STUCK if stuck else "", guess=guess, credit=credit)

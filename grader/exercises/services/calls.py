"""Calls as evidence, in the words and plain values that checks and students read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from rcl_interfaces.msg import Parameter as ParameterMessage
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python

from grader.checks import Missed, serves
from grader.checks.ends import declared
from grader.exercises.advice import advising
from sim.recording import Recording, Seconds

OURS = {"/pupil", "/technician", "/pilot", "/reader", "/tuner", "/operator"}  # nodes that ask the student's


class Call(NamedTuple):
    """One question to a service, whether a server took it, and its answer where one came."""

    client: str  # the node that asked
    asked: Seconds
    taken: Seconds | None
    answered: Seconds | None
    received: Seconds | None  # the client got the answer
    lost: bool  # nobody offered the service when it was asked
    service: str
    request: dict[str, Any]  # the fields of the request; of a parameter its name and value
    response: dict[str, Any]  # the fields of the response; {} without an answer

    @property
    def question(self) -> str:
        """The question in words: "/arm (data=True) at 1.5 s"."""
        return f"{self.service}{_brackets(self.request)} at {self.asked:.3g} s"


class Caller(Node):
    """A node of ours that calls the student's services, logs the answers, and never waits for one."""

    def ask(self, client: Client, request: Any) -> None:
        """Call a service, and log what comes of it."""
        question = f"{client.service_name}{_brackets(plain(request))}"
        if not client.service_is_ready():
            self.get_logger().info(f"{question}: nobody offers this service")
        future = client.call_async(request)
        future.add_done_callback(
            lambda future: self.get_logger().info(f"{question} -> {words(plain(future.result()))}")
        )


def plain(message: Any) -> dict[str, Any]:
    """The fields of a request or response and their values; those of parameters by the parameters' names."""
    values: dict[str, Any] = {}
    for field in message.get_fields_and_field_types():
        value = getattr(message, field)
        if field == "parameters":
            values |= {item.name: Parameter.from_parameter_msg(item).value for item in value}
        elif field == "results" and value:
            values |= {"successful": value[0].successful, "reason": value[0].reason}
        elif field == "values":
            values |= {"value": parameter_value_to_python(value[0]) if value else None}
        else:
            values[field] = value
    return values


def words(values: Mapping[str, Any]) -> str:
    """Values as a line: "success=True, message='armed'"."""
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def _brackets(values: Mapping[str, Any]) -> str:
    return f" ({words(values)})" if values else ""


def parameter(name: str, value: Any) -> ParameterMessage:
    """A parameter as set_parameters takes it."""
    return Parameter(name, value=value).to_parameter_msg()


def calls(recording: Recording, service: str) -> list[Call]:
    """The calls of a service, in the order they were asked."""
    return [
        Call(
            it.client,
            it.asked or 0.0,
            it.taken,
            it.answered,
            it.received,
            it.lost,
            it.service,
            plain(it.request),
            plain(it.response) if it.response else {},
        )
        for it in recording.calls_of(service)
    ]


def asked(recording: Recording, service: str, at_least: int = 1) -> list[Call]:
    """The calls of a service by ours. Raises Missed when the run ended before so many of ours were made."""
    made = [call for call in calls(recording, service) if call.client in OURS]
    if len(made) < at_least:
        expected = f"a run that lasts until {service} is called"
        raise Missed(expected if at_least == 1 else f"{expected} {at_least} times", recording.ended.detail)
    return made


def offers(recording: Recording, service: str, type: str) -> None:
    """Somebody offers a service of this type. Raises Missed with what is offered in its place."""
    name = type.rsplit("/", 1)[-1]
    with otherwise(f'self.create_service({name}, "{service}", self.callback) offers one.'):
        serves(recording, service, type)


def has_client(recording: Recording, service: str, type: str) -> None:
    """Somebody has a client for a service of this type. Raises Missed with the clients that there are."""
    name = type.rsplit("/", 1)[-1]
    with otherwise(f'self.client = self.create_client({name}, "{service}") makes one.'):
        declared(recording, "client", service, type, f"a client for {service} of type {type}")


@contextmanager
def otherwise(hint: str) -> Iterator[None]:
    """Give a miss in the block this hint, unless it has one."""
    try:
        yield
    except Missed as missed:
        raise Missed(missed.expected, missed.saw, missed.hint or hint, picture=missed.picture) from None


def accepted(call: Call) -> bool:
    """Was the answer yes?"""
    return bool(call.response.get("success", call.response.get("successful")))


def refused(call: Call) -> bool:
    """Was the answer no? Without any answer it was neither."""
    return bool(call.response) and not accepted(call)


def not_so(recording: Recording, expected: str, call: Call, hint: str, *, credit: float = 0.0) -> None:
    """Raise Missed for a call that was answered otherwise than it should have been, or not at all."""
    saw = words(call.response) or "no answer"
    if call.taken is not None and call.answered is None and not recording.errors:
        raise Missed(
            expected,
            saw,
            "The callback of the service has not come back: it waits, or goes round in a loop. Let it note "
            "in self what is wanted, and return the response at once.",
        )
    with advising(recording, hint):
        raise Missed(expected, saw, credit=credit)

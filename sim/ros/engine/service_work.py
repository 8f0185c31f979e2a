"""What services do with requests, and clients with responses, as callbacks that are recorded."""

from __future__ import annotations

import inspect
from typing import Any

from sim.ros.engine.callbacks import Work
from sim.ros.recorder.calls import Calls
from sim.ros.recorder.records import SERVICE

COMPLETE = "Questions._complete"  # the name of a response's callback in recordings: digests depend on it


def is_called(service: Any) -> bool:
    """Return whether a client has sent a request to a service of the run."""
    record = SERVICE.find(service)
    return record is not None and record.called


def service_work(calls: Calls, service: Any, node: Any, request: Any, header: Any) -> Work:
    """The work of a service that has taken a request: run its callback, and send the response."""
    call = calls.request_taken(service, node, header.request_id.sequence_number, request)

    SERVICE.of(service).unanswered[id(header)] = call

    def answer() -> None:
        with calls.answering(call):
            service.send_response(service.callback(request, service.srv_type.Response()), header)

    async def answer_later() -> None:
        with calls.answering(call):
            service.send_response(await service.callback(request, service.srv_type.Response()), header)

    function = answer_later if inspect.iscoroutinefunction(service.callback) else answer
    return Work("service", service, node, function, (), service.callback)


def response_work(calls: Calls, executor: Any, client: Any, node: Any, header: Any, response: Any) -> Work:
    """The work of a client that has taken a response: complete the future of its request."""

    def complete() -> None:
        try:
            future = client.get_pending_request(header.request_id.sequence_number)
        except KeyError:  # the request was removed
            return
        calls.response_received(client, header.request_id.sequence_number)
        future._set_executor(executor)
        future.set_result(response)

    complete.__qualname__ = COMPLETE
    return Work("client", client, node, complete)

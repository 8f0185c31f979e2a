"""What a judge asks for: a build in the sandbox. What comes back is looked at as any stranger's data."""

from __future__ import annotations

import base64
import binascii
import socket
from collections.abc import Callable

from grader.workspace.building import NOT_TAKEN, SECONDS, Built, checked_built
from grader.workspace.sources import Refused, Sources
from sim.ros.remote import Wire, WireError

MESSAGE = 8_000_000  # bytes
SPARE_S = 60.0  # until the process is there, on a busy machine
BROKE_OFF = "colcon build broke off."


def build_there(sock: socket.socket, sources: Sources, ending: Callable[[], str]) -> Built:
    """Let the process at the other end of the socket build. Raises nothing for the package's sake.

    ending: asked when it breaks off; how it ended, as a sentence, or "".
    """
    with sock:
        wire = Wire(sock, MESSAGE)
        try:
            wire.send(sources={path: base64.b64encode(data).decode() for path, data in sources.items()})
            answer = wire.receive(SECONDS + SPARE_S)
        except WireError:
            return Built(problem=f"{BROKE_OFF} {ending()}".strip())
    try:
        given = answer["files"].items()
        files = {path: base64.b64decode(text, validate=True) for path, text in given}
        return checked_built(files, *(answer.get(name) for name in ("programs", "said", "problem")))
    except (KeyError, AttributeError, TypeError, ValueError, binascii.Error):
        return Built(problem=f"{BROKE_OFF} It gave an answer that makes no sense.")
    except Refused as reason:
        return Built(problem=f"{NOT_TAKEN} {reason}")

"""A digest of a whole run."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, fields
from typing import Any

from sim.evidence.exchanges import Call, Goal
from sim.evidence.rows import Message
from sim.evidence.run_data import RunData

# Names that have changed since digests were first stored: an old run keeps its digest.
_NAMES = {
    "Message": "Heard",
    "from_course": "ours",
    "requested": "asked",
    "requested_by_course": "asked_by_us",
    "served_by_course": "served_by_us",
}


def digest_of(recording: RunData) -> str:
    """Return one hex string; equal runs have equal digests.

    Printed text is left out, because it may contain memory addresses, which differ each time.
    """
    digest = hashlib.blake2b(digest_size=16)
    for message in recording.published:
        digest.update(
            f"{message.stamp!r} {message.topic} {message.type} {message.sender} {message.from_course} "
            f"{message.early} {len(message.raw)} ".encode()
        )
        digest.update(message.raw)
    for exchange in (*recording.calls, *recording.goals):
        digest.update(_text_of(exchange).encode())
    digest.update(json.dumps(_evidence(recording), sort_keys=True).encode())
    return digest.hexdigest()


def _text_of(row: Any) -> str:
    """Return what `repr` gives for a call, a goal or a message, with the names of `_NAMES`."""
    if isinstance(row, list):
        return f"[{', '.join(map(_text_of, row))}]"
    if not isinstance(row, Call | Goal | Message):
        return repr(row)
    names = row._fields if isinstance(row, Message) else [field.name for field in fields(row)]
    values = (f"{_NAMES.get(name, name)}={_text_of(getattr(row, name))}" for name in names)
    return f"{_NAMES.get(type(row).__name__, type(row).__name__)}({', '.join(values)})"


def _evidence(recording: RunData) -> dict[str, Any]:
    of_network: dict[str, Any] = {}
    if recording.network is not None:
        of_network |= {"network": recording.network.to_data(), "hosts": recording.hosts}
        of_network["crossings"] = [asdict(crossing) for crossing in recording.crossings]
    drawn = {} if recording.drawing is None else {"drawing": asdict(recording.drawing)}
    return of_network | drawn | {
        "seconds": recording.seconds,
        "seed": recording.seed,
        "path": recording.path,
        "tracks": recording.tracks,
        "contacts": recording.contacts,
        "logs": recording.logs,
        "errors": [error._replace(traceback="") for error in recording.errors],
        "callbacks": recording.callbacks,
        "graph": asdict(recording.graph),
        "ended": recording.ended,
    }

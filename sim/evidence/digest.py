"""One number for a whole run."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sim.evidence.recording import Recording


def digest_of(recording: Recording) -> str:
    """One hex string: equal runs have equal ones.

    What was printed is left out: it is for the screen, and may hold addresses, which differ every time.
    """
    digest = hashlib.blake2b(digest_size=16)
    for heard in recording.heard:
        digest.update(
            f"{heard.stamp!r} {heard.topic} {heard.type} {heard.sender} {heard.ours} "
            f"{heard.early} {len(heard.raw)} ".encode()
        )
        digest.update(heard.raw)
    for exchange in (*recording.calls, *recording.goals):
        digest.update(repr(exchange).encode())
    digest.update(json.dumps(_evidence(recording), sort_keys=True).encode())
    return digest.hexdigest()


def _evidence(recording: Recording) -> dict[str, Any]:
    of_network = {}
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

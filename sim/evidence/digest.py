"""One number for a whole run."""

from __future__ import annotations

import hashlib
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import msgpack

if TYPE_CHECKING:
    from sim.evidence.recording import Recording


def digest_of(recording: Recording) -> str:
    """One hex string: equal runs have equal ones.

    What was printed is left out: it is for the screen, and may hold addresses, which differ every time.
    """
    packed = msgpack.packb(_evidence(recording), default=asdict, unicode_errors="surrogatepass")
    return hashlib.blake2b(packed, digest_size=16).hexdigest()


def _evidence(recording: Recording) -> list[Any]:
    return [
        recording.heard,
        recording.calls,
        recording.goals,
        recording.seconds,
        recording.seed,
        recording.path,
        sorted(recording.tracks.items()),
        recording.contacts,
        recording.logs,
        [error._replace(traceback="") for error in recording.errors],
        recording.callbacks,
        recording.graph,
        recording.ended,
        recording.drawing,
        recording.network and recording.network.to_data(),
        sorted(recording.hosts.items()),
        recording.crossings,
    ]

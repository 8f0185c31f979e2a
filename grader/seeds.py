"""Private seeds, derived from a secret that only the instructor has."""

from __future__ import annotations

import hashlib
import hmac
import json
from collections.abc import Mapping, Sequence

REVEALED = "seeds {"  # how a secret begins that is a table of seeds


def secret_of_student(secret: str, student: str) -> str:
    """The secret for one student's worlds and seeds: HMAC-SHA256(secret, "student NAME"), as hexadecimal.

    It is independent of when and where the student is marked. "" without a secret.
    """
    if secret.startswith(REVEALED):
        return secret
    name = f"student {student}".encode(errors="surrogateescape")
    return hmac.new(secret.encode(), name, hashlib.sha256).hexdigest() if secret else ""


def private_seed(secret: str, exercise: str, index: int, fair: Sequence[int] = ()) -> int:
    """The seed of an exercise's run: the first 4 bytes of HMAC-SHA256(secret, "exercise index").

    If there is a list of fair seeds, it is one of these.
    """
    if secret.startswith(REVEALED):
        return int(json.loads(secret.removeprefix("seeds "))[exercise][index])
    digest = hmac.new(secret.encode(), f"{exercise} {index}".encode(), hashlib.sha256).digest()
    drawn = int.from_bytes(digest[:4], "big")
    return fair[drawn % len(fair)] if fair else drawn


def revealed_seeds(seeds: Mapping[str, Sequence[int]]) -> str:
    """A secret that gives exactly these seeds: a list for each exercise, in the order of its runs."""
    return f"seeds {json.dumps(seeds)}"

"""Seeds: public ones that students see, and private ones from a secret that only an instructor has."""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Sequence


def secret_of_student(secret: str, student: str) -> str:
    """What one student's worlds and seeds are made from: HMAC-SHA256(secret, "student NAME"), as hexadecimal.

    It is the same whenever and wherever that student is marked. "" without a secret.
    """
    name = f"student {student}".encode(errors="surrogateescape")
    return hmac.new(secret.encode(), name, hashlib.sha256).hexdigest() if secret else ""


def private_seed(secret: str, exercise: str, index: int, fair: Sequence[int] = ()) -> int:
    """The seed of an exercise's run: the first 4 bytes of HMAC-SHA256(secret, "exercise index").

    Where there are seeds that alone are fair it is one of these.
    """
    digest = hmac.new(secret.encode(), f"{exercise} {index}".encode(), hashlib.sha256).digest()
    drawn = int.from_bytes(digest[:4], "big")
    return fair[drawn % len(fair)] if fair else drawn

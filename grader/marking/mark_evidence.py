"""What a mark is given for: digests of everything that decides it, and the versions of what marked."""
import hashlib
from dataclasses import replace

from grader.marking.submission.submitted_files import submission_key
from grader.marking.task import MarkingTask
from grader.marking.version import LOCK, lock_digest, versions


def fingerprint(secret: str) -> str:
    """Identifies a secret without revealing it."""
    return hashlib.sha256(secret.encode()).hexdigest()


def evidence(task: MarkingTask, secret: str) -> dict[str, str]:
    """The digests of submission, release, lock file and secret, and the versions, by name."""
    submission = submission_key(task.submitted, replace(task.release, digest=""), "", "")
    digests = {"submission": submission, "release": task.release.digest, LOCK: lock_digest()}
    return {**digests, "secret": fingerprint(secret), **versions()}

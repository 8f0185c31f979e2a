"""The hostile corpus where namespaces are forbidden: each gets there what it gets in the other sandbox."""
import json
import os
import re
import sys
from pathlib import Path

import pytest

from grader.marking.sandbox import separate_user
from tests.marking.hostile import corpus, packages
from tests.marking.hostile.test_corpus import EVERYBODY, FILES
from tests.marking.sandbox.attacks_on_users import owners
from tests.marking.sandbox.docker_like import run_in_container

pytestmark = pytest.mark.skipif(os.getuid() != 0, reason="only root makes separate users")
# One of fork, of files and of an honest student; then what attacks processes, memory, files and the network.
EVERY_DAY = ["honest_right", "fork_bomb", "secret_reader"]
FIRST = [
    *("honest_half", "honest_starter", "kills_its_parent", "spares_itself", "stops_itself", "world_reader"),
    *("solution_reader", "gradebook_writer", "network", "disk_bomb", "thread_bomb", "memory_bomb"),
    *("wire_forger", "wire_scribbler", "takes_over_the_wire", "closed_descriptors", "ends_the_process"),
    *("linked_secret", "hard_linked_secret", "replaced_modules"),
]
THEN = [name for name in EVERYBODY if name not in (*EVERY_DAY, *FIRST)]
GROUPS = [
    pytest.param(EVERY_DAY, id="every day"),
    pytest.param(FIRST, id="first", marks=pytest.mark.soak),
    pytest.param(THEN, id="then", marks=pytest.mark.soak),
]
CELL, AGAIN = "The notebook `topics` stopped in its code cell 5.", "It was started again."
STOPPED = "temperature 15, square 0 - stopped\n  Reason:"
# The words that a submission may get there as well, for the same points. A home is no file system of its own:
# it is looked at now and then. A process that isn't the first of its namespace really stops when it says so.
ALSO = {
    "disk_bomb": f"disk_bomb: {STOPPED} {CELL} The process wrote more than the 4096 files, or 128 MB, that "
                 f"are allowed. {AGAIN}",
    "stops_itself": f"stops_itself: {STOPPED} {CELL} It did not stop when it was interrupted. {AGAIN}\n"
                    "  Flag: The cell `extra` uses `os.kill`, which stops processes.\n"
                    "  Flag: The cell `extra` uses `signal.SIGSTOP`, which stops processes.",
    "thread_bomb": f"thread_bomb: {STOPPED} The notebook `topics` stopped in its cell `square-points`. The "
                   "process crashed: Aborted.",
}  # fmt: skip

# What a build may not write to is no other file system there, but another user's.
CLOSED = {
    "setup_installs_outside": packages.page()["setup_installs_outside"].replace(
        "Read-only file system", "Permission denied"
    )
}
HOME = re.compile(r"/tmp/confined-\w+/confined-\w+")  # of a user there, in place of /student


def blocks(kind: str, place: Path, names: list[str]) -> dict[str, str]:
    """What each of them gets in a container. The secret is in no result, and no process is left."""
    command = [sys.executable, "-m", "tests.marking.hostile.in_container", kind, str(place), *names]
    done = run_in_container(*command)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["leaked"] is False
    left = {user for user in owners().values() if user in separate_user.USERS}
    assert [user for user in left if not (separate_user.LOCKS / str(user)).exists()] == []
    return found["blocks"]


@pytest.mark.parametrize("names", GROUPS)
def test_in_a_container_a_submission_gets_its_points_and_words(tmp_path, names):
    found, page = blocks("notebooks", tmp_path, names), corpus.page()
    assert {name: page[name] if found[name] == ALSO.get(name) else found[name] for name in names} == {
        name: page[name] for name in names
    }


@pytest.mark.soak
def test_in_a_container_a_package_gets_its_points_and_words(tmp_path):
    found = blocks("packages", tmp_path, list(packages.TRICKS))
    assert {name: HOME.sub("/student", text) for name, text in found.items()} == packages.page() | CLOSED


def test_every_trick_is_tried():
    assert {*EVERY_DAY, *FIRST, *THEN} == {*EVERYBODY} > {*FILES}

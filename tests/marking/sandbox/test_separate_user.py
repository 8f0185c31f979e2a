"""Where namespaces are forbidden, as in a container with Docker's settings: attacks_on_users.py there."""
import os
import re
import sys
import tempfile
from pathlib import Path

import pytest

from tests.marking.sandbox import attacks_on_users
from tests.marking.sandbox.docker_like import run_in_container

ROOT = Path(__file__).parents[3]
PATH = {"PYTHONPATH": str(ROOT)}
ATTACKS = [name for name in vars(attacks_on_users) if name.startswith("test_")]
OUTCOME = re.compile(r"^(PASSED|FAILED|ERROR|SKIPPED)\s+\S*?::(test_\w+)", re.M)

pytestmark = pytest.mark.skipif(os.getuid() != 0, reason="only root makes separate users")


def outcomes(landlock: bool) -> tuple[dict[str, set[str]], str]:
    """The outcomes of each attack in such a container, and what pytest printed."""
    options = ["-n", "0", "-rA", "-q", "-p", "no:cacheprovider", "--tb=short", f"--rootdir={ROOT}"]
    command = [sys.executable, "-m", "pytest", *options, f"--config-file={ROOT}/pyproject.toml"]
    with tempfile.TemporaryDirectory() as place:  # which only root can enter
        done = run_in_container(
            *command, attacks_on_users.__file__, landlock=landlock, cwd=place, env=os.environ | PATH
        )
    found: dict[str, set[str]] = {}
    for outcome, name in OUTCOME.findall(done.stdout):
        found.setdefault(name, set()).add(outcome)
    return found, done.stdout + done.stderr


@pytest.fixture(scope="module")
def with_landlock() -> tuple[dict[str, set[str]], str]:
    return outcomes(landlock=True)


@pytest.mark.parametrize("attack", [name for name in ATTACKS if "landlock_is_missing" not in name])
def test_nothing_is_reached_from_a_separate_user(with_landlock, attack):
    found, printed = with_landlock
    assert found.get(attack) == {"PASSED"}, printed


@pytest.mark.soak
def test_without_landlock_modes_of_files_protect_what_must_be_closed():
    found, printed = outcomes(landlock=False)
    landlocked = {name for name in found if found[name] != {"PASSED"}}
    assert landlocked == set(), printed
    assert "test_where_landlock_is_missing_what_must_be_closed_has_to_be_closed_by_its_mode" in found

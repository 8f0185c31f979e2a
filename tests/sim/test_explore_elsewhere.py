"""Tests that `explore` works in a package outside the course: the one that sim/README.md shows."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

README = Path(__file__).parents[2] / "sim/README.md"
BLOCK = re.compile(r"^```(?:python\n# (?P<file>\S+)|text)\n(?P<text>.*?)^```$", re.M | re.S)
REENTRANT, EXCLUSIVE = "ReentrantCallbackGroup", "MutuallyExclusiveCallbackGroup"


@pytest.fixture
def package(tmp_path):
    """A folder with the package of the page."""
    for block in BLOCK.finditer(section()):
        if block["file"]:
            file = tmp_path / block["file"]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block["text"], encoding="utf-8")
    return tmp_path


def section() -> str:
    """The section of the page about one's own package."""
    return README.read_text(encoding="utf-8").partition("### Your own package")[2].partition("\n## ")[0]


def pytest_in(folder: Path) -> subprocess.CompletedProcess[str]:
    """Call pytest there, as a user does."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--tb=short"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


def test_a_race_in_a_package_is_found_by_its_own_test(package):
    result = pytest_in(package)
    assert result.returncode == 1, result.stdout
    (shown,) = (block["text"] for block in BLOCK.finditer(section()) if not block["file"])
    printed = " ".join(result.stdout.split())
    assert " ".join(shown.split()).removeprefix("E AssertionError: ") in printed


def test_the_right_package_passes(package):
    module = package / "belt/counter.py"
    source = module.read_text(encoding="utf-8")
    assert REENTRANT in source
    module.write_text(source.replace(REENTRANT, EXCLUSIVE), encoding="utf-8")
    result = pytest_in(package)
    assert result.returncode == 0, result.stdout

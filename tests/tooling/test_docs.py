"""Holds README and CONTRIBUTING to what is really there."""
import importlib
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = ["README.md", "CONTRIBUTING.md"]
PLACEHOLDERS = re.compile(r"NN_TOPIC|TOPIC|NAME")
# Ignored by git: commands make them.
MADE_LATER = (".pytest_cache/", "class/", "dist/", "test-artifacts/", "wheels/", "work/")


def text(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def mapped() -> Iterator[tuple[str, str]]:
    """Yield path and description of every row of README's map; indented rows lie in the folder above."""
    rows = re.search(r"## The map\n+```\n(.*?)```", text("README.md"), re.S)[1]
    folder = ""
    for indent, name, description in re.findall(r"^( *)(\S+) +(.+)$", rows, re.M):
        depth = len(indent) // 2
        folder = "/".join(folder.split("/")[:depth])
        path = f"{folder}/{name}" if folder else name
        yield path, description
        folder = path.rstrip("/")


def tracked() -> set[str]:
    """Return the names at the top of the repository, folders with / at their end."""
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return {path.split("/")[0] + "/" * ("/" in path) for path in files.splitlines()}


def test_the_map_names_only_what_exists():
    wrong = [path for path, _ in mapped() if (ROOT / path).is_dir() != path.endswith("/")]
    assert wrong + [path for path, _ in mapped() if not (ROOT / path).exists()] == []


def test_the_map_names_everything_at_the_top():
    assert tracked() - {path for path, _ in mapped()} == {".gitignore"}


def test_the_doors_on_the_map_are_the_packages_doors():
    doors = {path: words for path, words in mapped() if words.startswith("the door: ")}
    assert set(doors) == {"sim/__init__.py", "grader/__init__.py"}
    for path, words in doors.items():
        package = importlib.import_module(path.split("/")[0])
        assert sorted(words.removeprefix("the door: ").split(", ")) == sorted(package.__all__)


@pytest.mark.parametrize("page", PAGES)
def test_every_make_command_is_a_target(page):
    targets = set(re.findall(r"^([a-z]+):", text("Makefile"), re.M))
    named = re.findall(r"(?:^|`)make((?: +\w+=\S+)*) +([a-z]+)\b", text(page), re.M)
    assert len(named) > 4
    assert {target for _, target in named} - targets == set()


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page):
    links = re.findall(r"\]\(([^)#]+)", text(page))
    assert [link for link in links if "://" not in link and not (ROOT / link).exists()] == []


@pytest.mark.parametrize("page", PAGES)
def test_every_path_in_the_text_exists(page):
    quoted = re.findall(r"`([\w.-]+/[\w./-]*)`", text(page))
    paths = [path for path in quoted if not path.startswith(MADE_LATER)]
    assert len(paths) > 3
    assert [path for path in paths if not list(ROOT.glob(PLACEHOLDERS.sub("*", path)))] == []

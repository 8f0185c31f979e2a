"""Compares the READMEs and the pages for contributors with the files that they name."""
import importlib
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MAPS = ["README.md", "sim/README.md", "grader/README.md"]
PAGES = [*MAPS, "CONTRIBUTING.md", ".ci/REFERENCE.md", ".ci/REVIEWING.md", ".ci/RELEASING.md"]
PAGES += ["tests/bench/README.md"]
MOST = 120  # lines of the front page
PLACEHOLDERS = re.compile(r"NN_TOPIC|TOPIC|NAME")
# Ignored by git: commands make them.
MADE_LATER = (".pytest_cache/", "class/", "dist/", "test-artifacts/", "wheels/", "work/")


def text(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def mapped(page: str = "README.md") -> Iterator[tuple[str, str]]:
    """Yield path and description of every row of a page's map; indented rows are in the folder above."""
    rows = re.search(r"## The map\n+```\n(.*?)```", text(page), re.S)[1]
    begin = (ROOT / page).parent.relative_to(ROOT)
    folder = ""
    for indent, name, description in re.findall(r"^( *)(\S+) +(.+)$", rows, re.M):
        depth = len(indent) // 2
        folder = "/".join(folder.split("/")[:depth])
        path = f"{folder}/{name}" if folder else name
        yield (begin / path).as_posix() + "/" * name.endswith("/"), description
        folder = path.rstrip("/")


def tracked() -> set[str]:
    """Return the names at the top of the repository, folders with / at their end."""
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return {path.split("/")[0] + "/" * ("/" in path) for path in files.splitlines()}


@pytest.mark.parametrize("page", MAPS)
def test_a_map_names_only_what_exists(page):
    wrong = [path for path, _ in mapped(page) if (ROOT / path).is_dir() != path.endswith("/")]
    assert wrong + [path for path, _ in mapped(page) if not (ROOT / path).exists()] == []


@pytest.mark.parametrize("page", MAPS[1:])
def test_a_package_s_map_names_all_its_folders(page):
    folder = (ROOT / page).parent
    packages = [path for path in folder.iterdir() if (path / "__init__.py").exists()]
    found = {path.relative_to(ROOT).as_posix() + "/" for path in packages}
    assert found - {path for path, _ in mapped(page)} == set()


def test_the_front_page_is_short():
    assert text("README.md").count("\n") <= MOST


def test_the_map_names_everything_at_the_top():
    assert tracked() - {path for path, _ in mapped()} == {".gitignore"}


@pytest.mark.parametrize("page", MAPS)
def test_the_public_names_on_a_map_are_those_of_the_package(page):
    rows = {path: row for path, row in mapped(page) if row.startswith("public names: ")}
    assert set(rows) <= {"sim/__init__.py", "grader/__init__.py"} and rows
    for path, row in rows.items():
        package = importlib.import_module(path.split("/")[0])
        assert sorted(row.removeprefix("public names: ").split(", ")) == sorted(package.__all__)


@pytest.mark.parametrize("page", PAGES)
def test_every_make_command_is_a_target(page):
    targets = set(re.findall(r"^([a-z]+):", text("Makefile"), re.M))
    named = re.findall(r"(?:^|`)make((?: +\w+=\S+)*) +([a-z]+)\b", text(page), re.M)
    assert {target for _, target in named} - targets == set()


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page):
    links, folder = re.findall(r"\]\(([^)#]+)", text(page)), (ROOT / page).parent
    assert [link for link in links if "://" not in link and not (folder / link).exists()] == []


@pytest.mark.parametrize("page", PAGES)
def test_every_path_in_the_text_exists(page):
    quoted = re.findall(r"`([\w.-]+/[\w./-]*)`", text(page))
    paths = [path for path in quoted if not path.startswith(MADE_LATER)]
    assert [path for path in paths if not list(ROOT.glob(PLACEHOLDERS.sub("*", path)))] == []

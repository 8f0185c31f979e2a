"""What is in a submission's folder, and what is read of it."""

import os
import pickle
import shutil
import socket
import tempfile
from pathlib import Path

import pytest

from grader.marking.errors import CourseError
from grader.marking.submission import assignment_release, submitted_files
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.rebuild import rebuild_submission
from grader.marking.submission.submitted_files import MAX_NOTEBOOK_BYTES, read_folder, submission_key
from grader.marking.submission.untrusted_folder import MAX_ENTRIES, list_entries
from tests.marking.submission.damage import (
    NODES,
    ROOT,
    SOLVED,
    STARTER,
    data,
    own,
    rebuilt_folder,
    same,
    solved,
    submit,
    verdict,
)

WHOLE = data(SOLVED)
OTHERS = data({**solved(), "cells": [own("print('my notes')")]})
FILE_ITSELF = "Hand in the file itself, as JupyterLab gives it (File, Download)."


@pytest.fixture
def folder(tmp_path) -> Path:
    return submit(tmp_path)


@pytest.fixture
def as_no_one():
    """An open folder that belongs to no one, and the rights of no one: root may read everything."""
    place = Path(tempfile.mkdtemp())
    if os.geteuid() == 0:
        os.chown(place, 65534, 65534)
        os.seteuid(65534)
    yield place
    if os.getuid() == 0:
        os.seteuid(0)
    for path in place.rglob("*"):
        path.chmod(0o700)
    shutil.rmtree(place)


def link(path: Path, target: str) -> None:
    path.symlink_to(target)


def listen(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as server:
        os.chdir(path.parent)  # a socket's path is short
        server.bind(path.name)


def sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(10_000_000_000)


@pytest.mark.parametrize("name", ["nodes (1).ipynb", "Nodes.ipynb", "alice_nodes.ipynb", "a/nodes.ipynb"])
def test_a_notebook_under_another_name_is_taken_if_it_is_the_only_one_with_our_cells(name, folder):
    (folder / name).parent.mkdir(exist_ok=True)
    (folder / name).write_bytes(WHOLE)
    (folder / "notes.ipynb").write_bytes(OTHERS)
    rebuilt = rebuilt_folder(folder)
    assert rebuilt.repairs == [
        f"`{name}` was used as `nodes.ipynb`.",
        "Handed in alongside the notebook and not used: `notes.ipynb`.",
    ]
    assert same(rebuilt.notebooks["nodes"].notebook)


def test_of_several_notebooks_the_one_with_the_right_name_is_taken(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    (folder / "nodes (1).ipynb").write_bytes(data(STARTER))
    beside = "Handed in alongside the notebook and not used: `nodes (1).ipynb`."
    assert rebuilt_folder(folder).repairs == [beside]


def test_two_notebooks_that_could_be_it_are_refused(folder):
    (folder / "nodes (1).ipynb").write_bytes(WHOLE)
    (folder / "nodes-final.ipynb").write_bytes(WHOLE)
    assert verdict(folder) == (
        "Expected the notebook `nodes.ipynb`, saw `nodes (1).ipynb` and `nodes-final.ipynb`, more than one. "
        "Hand in one under this name."
    )


def test_a_notebook_that_is_not_there_is_missed(folder):
    words = "Expected the notebook `nodes.ipynb`, saw none. Hand it in under this name."
    assert verdict(folder) == words
    (folder / "answer.py").write_text("x = 1")
    checkpoints = folder / ".ipynb_checkpoints"
    checkpoints.mkdir()
    (checkpoints / "nodes-checkpoint.ipynb").write_bytes(WHOLE)
    (folder / ".nodes.ipynb").write_bytes(WHOLE)
    assert verdict(folder) == words


def test_other_notebooks_instead_are_named(folder):
    (folder / "notes.ipynb").write_bytes(OTHERS)
    (folder / "torn.ipynb").write_bytes(b"{")
    assert verdict(folder) == (
        "Expected the notebook `nodes.ipynb`, saw only `notes.ipynb` and `torn.ipynb`, without its cells. "
        "Hand in one under this name."
    )


def test_the_notebook_of_another_assignment_is_refused(folder):
    topics = (ROOT / "exercises" / "02_topics" / "topics.ipynb").read_bytes()
    (folder / "nodes.ipynb").write_bytes(topics)
    assert verdict(folder) == (
        "Expected a notebook with this assignment's cells (`battery`, `battery-points`, `counter`, "
        "`counter-points`, `heart` and 8 more), saw those of another (`greeting`, `greeting-points`, "
        "`temperature`, `temperature-points`, `commands` and 9 more). "
        "Hand in the notebook of this assignment."
    )
    (folder / "nodes.ipynb").rename(folder / "topics.ipynb")
    assert "saw only `topics.ipynb`, without its cells" in verdict(folder)


def test_no_folder_at_all_is_reported(tmp_path):
    assert verdict(tmp_path / "absent") == "Expected a notebook, saw nothing: no folder was handed in."


@pytest.mark.parametrize("make", [lambda path: path.symlink_to(ROOT / "solutions" / "01_nodes"), Path.touch])
def test_a_folder_that_is_none_is_not_followed(make, tmp_path):
    make(tmp_path / "01_nodes")
    words = "Expected a folder with a notebook, saw a link or a file. Hand in the notebook itself."
    assert verdict(tmp_path / "01_nodes") == words


SURPRISES = {
    "a link": lambda path: link(path, str(ROOT / "solutions" / "01_nodes" / "nodes.ipynb")),
    "a link to itself": lambda path: link(path, path.name),
    "a link to nothing": lambda path: link(path, "nowhere"),
    "a pipe": os.mkfifo,
    "a folder": Path.mkdir,
    "a socket": listen,
}


@pytest.mark.parametrize("surprise", SURPRISES)
def test_only_a_regular_file_is_opened(surprise, folder, monkeypatch):
    monkeypatch.chdir(folder)
    SURPRISES[surprise](folder / "nodes.ipynb")
    what = " ".join(surprise.split()[:2])
    assert verdict(folder) == f"`nodes.ipynb` is {what}; expected a notebook's file. {FILE_ITSELF}"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can make a device")
def test_a_device_is_not_opened(folder):
    os.mknod(folder / "nodes.ipynb", 0o20600, os.makedev(1, 5))  # /dev/zero
    assert verdict(folder) == f"`nodes.ipynb` is a device; expected a notebook's file. {FILE_ITSELF}"


def test_no_folder_on_the_way_is_a_link(folder, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "nodes.ipynb").write_bytes(WHOLE)
    link(folder / "mine", str(elsewhere))
    assert verdict(folder) == "Expected the notebook `nodes.ipynb`, saw none. Hand it in under this name."


def test_a_huge_file_is_not_read(folder):
    sparse(folder / "nodes.ipynb")
    assert verdict(folder) == (
        "`nodes.ipynb` has 10000 MB; at most 128 MB can be marked. Clear its outputs (Edit, Clear Outputs of "
        "All Cells), save it and hand it in again."
    )


def test_a_file_or_folder_that_can_not_be_read_is_reported(as_no_one):
    (as_no_one / "nodes.ipynb").write_bytes(WHOLE)
    (as_no_one / "nodes.ipynb").chmod(0)
    words = "`nodes.ipynb` cannot be read (Permission denied). Hand in a file that can be read."
    assert verdict(as_no_one) == words
    (as_no_one / "locked").mkdir(0)
    assert [entry.path for entry in list_entries(as_no_one)] == ["locked", "nodes.ipynb"]
    assert verdict(as_no_one / "locked") == (
        "Expected a folder with a notebook, saw one that cannot be read (Permission denied). "
        "Hand in the notebook itself."
    )


def test_other_files_are_not_used_and_named_once(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    for name in ["matplotlib.py", "sitecustomize.py", "data.csv", ".hidden", "z1", "z2", "timestamp.txt"]:
        (folder / name).write_text("2026-11-21 09:00:00 UTC")
    (folder / ".ipynb_checkpoints").mkdir()
    (folder / ".ipynb_checkpoints" / "nodes-checkpoint.ipynb").write_bytes(OTHERS)
    rebuilt = rebuilt_folder(folder)
    assert rebuilt.repairs == [
        "Handed in alongside the notebook and not used: `.hidden`, `data.csv`, `matplotlib.py`, "
        "`sitecustomize.py`, `z1` and 1 more."
    ]
    assert same(rebuilt.notebooks["nodes"].notebook)


def test_what_a_cell_writes_and_what_tools_leave_is_not_mentioned(folder):
    writes = own("%%writefile my_weather.py\nx = 1")
    (folder / "nodes.ipynb").write_bytes(data({**solved(), "cells": [*solved()["cells"], writes]}))
    for name in ("my_weather.py", "other.py"):
        (folder / name).write_text("x = 1")
    (folder / "__pycache__").mkdir()
    repairs = rebuilt_folder(folder).repairs
    assert "Handed in alongside the notebook and not used: `other.py`." in repairs
    assert "my_weather" not in " ".join(repairs)


def test_names_of_files_cannot_break_a_sentence(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    for name in [b"\xff`x`\n\x1b[31m<b>", b"a" * 200]:
        Path(os.fsdecode(bytes(folder) + b"/" + name)).touch()
    assert rebuilt_folder(folder).repairs == [
        f"Handed in alongside the notebook and not used: `{'a' * 59}…` and `??x???[31m<b>`."
    ]


def test_the_releases_own_data_are_not_complained_of(folder, tmp_path):
    release = tmp_path / "exercises" / "01_nodes"
    (release / "maps").mkdir(parents=True)
    (release / "nodes.ipynb").write_bytes(data(STARTER))
    (release / "maps" / "room.csv").touch()
    (release / "speeds.csv").touch()
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    (folder / "speeds.csv").write_text("other figures")
    (folder / "maps").mkdir()
    assert set(load_release(release).files) == {"maps/room.csv", "speeds.csv"}
    assert rebuilt_folder(folder, load_release(release)).repairs == []


def test_one_of_two_notebooks_is_marked_and_the_other_is_missed(folder, tmp_path):
    release = tmp_path / "exercises" / "01_nodes"
    release.mkdir(parents=True)
    for name in ("nodes", "more"):
        (release / f"{name}.ipynb").write_bytes(data(STARTER))
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    rebuilt = rebuilt_folder(folder, load_release(release))
    assert rebuilt.missing == {
        "more": "Expected the notebook `more.ipynb`, saw none. Hand it in under this name."
    }
    assert (list(rebuilt.notebooks), rebuilt.repairs) == (["nodes"], [])
    (folder / "more.ipynb").write_bytes(OTHERS)
    assert "saw none of them." in rebuilt_folder(folder, load_release(release)).missing["more"]
    (folder / "nodes.ipynb").write_bytes(b"")
    assert verdict(folder, load_release(release)).startswith("`nodes.ipynb` is empty;")


def test_a_folder_without_end_is_looked_into_only_so_far(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    deep = folder
    for _ in range(20):
        deep = deep / "again"
        deep.mkdir()
    assert len(list_entries(folder)) == 1 + 4
    beside = "Handed in alongside the notebook and not used: `again/`."
    assert rebuilt_folder(folder).repairs == [beside]


def test_among_very_many_files_the_notebook_is_found(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    for number in range(MAX_ENTRIES + 1):
        (folder / f"{number}.txt").touch()
    assert len(list_entries(folder)) == MAX_ENTRIES
    assert same(rebuilt_folder(folder).notebooks["nodes"].notebook)
    before = key(folder)
    (folder / "nodes.ipynb").write_bytes(data(STARTER))
    assert key(folder) != before


def test_of_very_many_notebooks_no_more_is_read_than_takes_a_moment(folder, monkeypatch):
    read = []
    monkeypatch.setattr(submitted_files, "read_file", lambda _, path, limit: read.append(path) or b"")
    for number in range(100):
        (folder / f"{number:02}.ipynb").touch()
    os.truncate(folder / "00.ipynb", MAX_NOTEBOOK_BYTES)
    os.truncate(folder / "01.ipynb", 1)
    small = [f"{number:02}.ipynb" for number in range(2, 21)]
    assert verdict(folder).startswith("Expected the notebook `nodes.ipynb`, saw only `00.ipynb`, `02.ipynb`,")
    assert read == ["00.ipynb", *small]
    read.clear()
    key(folder)
    assert [path for path in read if path != "nodes.ipynb"] == ["00.ipynb", *small]


def key(folder: Path, fingerprint: str = "secret", version: str = "1", place: Path | None = None) -> str:
    release = load_release(place or ROOT / "exercises" / "01_nodes")
    return submission_key(read_folder(folder, release), release, fingerprint, version)


def test_the_same_submission_has_the_same_key_and_any_other_another(folder, tmp_path):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    copied = shutil.copytree(folder, tmp_path / "copy")
    assert key(folder) == key(copied)
    keys = {key(folder), key(folder, "other"), key(folder, version="2")}
    keys.add(key(folder, place=ROOT / "exercises" / "02_topics"))
    for content in (WHOLE + b" ", data(STARTER), b""):
        (folder / "nodes.ipynb").write_bytes(content)
        keys.add(key(folder))
    (folder / "data.csv").touch()
    keys.add(key(folder))
    assert len(keys) == 8
    assert all(len(each) == 64 and int(each, 16) for each in keys)


def test_a_key_changes_with_the_releases_data_but_not_with_the_time_of_handing_in(folder, tmp_path):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    release = shutil.copytree(ROOT / "exercises" / "01_nodes", tmp_path / "release")
    keys = [key(folder, place=release)]
    (folder / "timestamp.txt").write_text("2026-11-21 09:00:00 UTC")
    keys.append(key(folder, place=release))
    for figures in ("1", "2"):
        (release / "speeds.csv").write_text(figures)
        keys.append(key(folder, place=release))
    assert keys[0] == keys[1]
    assert len(set(keys)) == 3


@pytest.mark.parametrize("surprise", [*SURPRISES.values(), sparse], ids=[*SURPRISES, "a sparse file"])
def test_whatever_was_handed_in_has_a_key(surprise, folder, monkeypatch):
    monkeypatch.chdir(folder)
    surprise(folder / "nodes.ipynb")
    assert key(folder) == key(folder) != key(folder.parent)
    assert key(folder / "nodes.ipynb") != key(folder / "nowhere")
    assert MAX_NOTEBOOK_BYTES < 10**9


def test_a_file_that_can_not_be_read_has_a_key(as_no_one):
    (as_no_one / "nodes.ipynb").touch(mode=0)
    unreadable = key(as_no_one)
    (as_no_one / "nodes.ipynb").chmod(0o600)
    assert key(as_no_one) != unreadable


def test_what_was_read_is_the_same_on_another_machine(folder):
    (folder / "nodes.ipynb").write_bytes(WHOLE)
    (folder / os.fsdecode(b"caf\xe9.ipynb")).write_bytes(OTHERS)
    link(folder / "link.ipynb", "/etc/passwd")
    here = read_folder(folder, NODES)
    there = pickle.loads(pickle.dumps(here))
    shutil.rmtree(folder)
    assert there == here
    assert same(rebuild_submission(there, pickle.loads(pickle.dumps(NODES))).notebooks["nodes"].notebook)


def test_files_that_a_release_brings_along_are_limited(tmp_path, monkeypatch):
    monkeypatch.setattr(assignment_release, "MAX_RELEASE_BYTES", 3)
    (tmp_path / "map.txt").write_text("wall")
    with pytest.raises(CourseError, match=r"have 0 MB; expected 3e-06 at most$"):
        load_release(tmp_path)

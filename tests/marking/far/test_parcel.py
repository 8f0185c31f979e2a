import os
import socket
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from grader.marking.far.parcel import pack, unpack
from grader.marking.mending.folder import entries, read_file
from grader.marking.mending.words import Unusable

LIMIT = 1_000_000
NOBODY = 65534


def there(folder: Path, target: Path) -> Path:
    """The folder as it arrives elsewhere."""
    unpack(pack(folder), target)
    return target


def seen(folder: Path) -> list[tuple]:
    """All that marking can see of a folder."""
    return [(entry.path, entry.kind, entry.size, read(folder, entry.path)) for entry in entries(folder)]


def read(folder: Path, path: str) -> bytes | str:
    try:
        return read_file(folder, path, LIMIT)
    except Unusable as reason:
        return str(reason)


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "here" / "data" / "more").mkdir(parents=True)
    return tmp_path / "here"


def test_files_and_folders_arrive_as_they_are(folder, tmp_path):
    (folder / "nodes.ipynb").write_bytes(os.urandom(1000))
    (folder / "empty.ipynb").touch()
    (folder / "data" / "more" / "öl.csv").write_text("1,2\n")
    (folder / os.fsdecode(b"caf\xe9.ipynb")).write_text("{}")
    assert seen(there(folder, tmp_path / "there")) == seen(folder)


def test_what_is_no_ordinary_file_is_named_the_same(folder, tmp_path, monkeypatch):
    os.mkfifo(folder / "pipe.ipynb")
    monkeypatch.chdir(folder)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket.ipynb")
    (folder / "large.ipynb").touch()
    os.truncate(folder / "large.ipynb", 130_000_000)
    expected = seen(folder)
    (folder / "link.ipynb").symlink_to("/etc/passwd")
    found = {entry.path: entry.kind for entry in entries(there(folder, tmp_path / "there"))}
    assert found.pop("link.ipynb") == "a link"
    assert os.readlink(tmp_path / "there" / "link.ipynb") == "nowhere"
    (tmp_path / "there" / "link.ipynb").unlink()
    assert seen(tmp_path / "there") == expected


def test_only_files_with_the_ending_travel(folder, tmp_path):
    (folder / "nodes.ipynb").write_text("{}")
    (folder / "bag.mcap").write_bytes(b"1" * 1000)
    parcel = pack(folder, ".ipynb")
    assert [item["path"] for item in parcel if item["data"]] == ["nodes.ipynb"]
    unpack(parcel, tmp_path / "there")
    assert entries(tmp_path / "there") == entries(folder)


@pytest.mark.parametrize("kind", ["nothing", "a link", "a file", "a pipe"])
def test_what_is_no_folder_is_refused_with_the_same_words(tmp_path, kind):
    here = tmp_path / "here"
    match kind:
        case "a link":
            here.symlink_to(tmp_path)
        case "a file":
            here.touch()
        case "a pipe":
            os.mkfifo(here)
    there(here, tmp_path / "there")
    words = []
    for folder in (here, tmp_path / "there"):
        with pytest.raises(Unusable) as reason:
            entries(folder)
        words.append(str(reason.value))
    assert words[0] == words[1]


@pytest.fixture
def closed() -> Iterator[Path]:
    """A folder with something that its owner may not read, where this process is no more than that owner."""
    root = os.geteuid() == 0
    if root:
        os.seteuid(NOBODY)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "here" / "locked").mkdir(parents=True)
        (Path(folder) / "here" / "nodes.ipynb").touch()
        for path in ("here/locked", "here/nodes.ipynb"):
            (Path(folder) / path).chmod(0)
        yield Path(folder)
    if root:
        os.seteuid(0)


def test_what_may_not_be_read_may_not_be_read_there(closed):
    found = seen(closed / "here")
    assert "cannot be read (Permission denied)" in found[1][-1]
    assert seen(there(closed / "here", closed / "there")) == found
    (closed / "here").chmod(0)
    unpack(pack(closed / "here"), closed / "nothing")
    with pytest.raises(Unusable, match="Permission denied"):
        entries(closed / "nothing")


def test_a_device_arrives_as_a_pipe_for_only_root_can_make_one(tmp_path):
    item = {"size": 0, "data": b"", "closed": False}
    parcel = [{"path": "", "kind": "a folder", **item}, {"path": "tty", "kind": "a device", **item}]
    unpack(parcel, tmp_path / "there")
    assert [entry.kind for entry in entries(tmp_path / "there")] == ["a pipe"]

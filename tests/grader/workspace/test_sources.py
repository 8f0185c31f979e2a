"""The files of a workspace: what is taken, and the words for what is not."""

import os
import socket

import pytest

from grader.workspace.sources import InvalidFiles, SizeLimits, read_files, validate_files

SMALL = SizeLimits(files=3, file=1000, all=2000, deep=2)


def refusal(folder, most=SMALL):
    with pytest.raises(InvalidFiles) as refused:
        read_files(folder, "ws/src", most)
    return str(refused.value)


def write(folder, *paths, size=1):
    for path in paths:
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(b"x" * size)


def test_files_are_read_by_their_paths_without_what_tools_leave(tmp_path):
    left = ".git/config", "a/__pycache__/m.pyc", "a.egg-info/PKG-INFO", ".ipynb_checkpoints/a", "a/m.pyc"
    built = "a/build/COLCON_IGNORE", "a/build/more/x"
    write(tmp_path, "a/package.xml", "a/b/c.py", *left, *built)
    assert read_files(tmp_path, "ws/src") == {"a/package.xml": b"x", "a/b/c.py": b"x"}


def test_no_folder_has_no_files(tmp_path):
    assert read_files(tmp_path / "ws", "ws/src") == {}


def test_a_file_or_a_link_is_no_folder(tmp_path):
    write(tmp_path, "file")
    (tmp_path / "link").symlink_to(tmp_path)
    words = "ws/src is not a folder. Put your packages into a folder of this name."
    assert {refusal(tmp_path / name) for name in ("file", "link")} == {words}


def test_what_is_no_file_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a socket's address is short
    for name in ("link", "pipe", "socket", "loop"):
        (tmp_path / name).mkdir()
    (tmp_path / "link/passwd").symlink_to("/etc/passwd")
    (tmp_path / "loop/up").symlink_to("..")
    os.mkfifo(tmp_path / "pipe/p")
    listening = socket.socket(socket.AF_UNIX)
    listening.bind("socket/s")
    listening.close()
    words = "Only files are used: put the file itself there."
    assert refusal(tmp_path / "link") == f"`ws/src/passwd` is a link. {words}"
    assert refusal(tmp_path / "loop") == f"`ws/src/up` is a link. {words}"
    assert refusal(tmp_path / "pipe") == f"`ws/src/p` is a pipe. {words}"
    assert refusal(tmp_path / "socket") == f"`ws/src/s` is a socket. {words}"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can make a device")
def test_a_device_is_refused(tmp_path):
    try:
        os.mknod(tmp_path / "null", 0o20666, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("not even root can make a device here")
    words = "`ws/src/null` is a device. Only files are used: put the file itself there."
    assert refusal(tmp_path) == words


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("my file.py", "my file.py"),
        ("-\n`rm`", "-??rm?"),
        ("ä" * 90, "ä" * 79 + "…"),
        ("a" * 101, "a" * 79 + "…"),
    ],
)
def test_a_name_is_plain(tmp_path, name, shown):
    write(tmp_path, name)
    assert (
        refusal(tmp_path)
        == f"`ws/src/{shown}`: a name may have 100 letters, digits and `_ . + -`. Rename it."
    )


def test_too_many_too_large_and_too_deep_are_refused(tmp_path):
    write(tmp_path / "many", *(f"f{number}" for number in range(2000)))
    write(tmp_path / "large", "a", size=10_000_000)
    write(tmp_path / "heavy", "a", "b", "c", size=999)
    write(tmp_path / "deep", "a/b/c/d")
    assert refusal(tmp_path / "many") == "ws/src has more than 3 files. Leave out what isn't needed."
    assert refusal(tmp_path / "large") == "`ws/src/a` has more than 1 kB. Leave out what isn't source code."
    assert refusal(tmp_path / "heavy") == "ws/src has more than 0.002 MB. Leave out what isn't source code."
    assert refusal(tmp_path / "deep") == "`ws/src/a/b/c` is more than 2 folders deep. Move it up."


def test_what_another_process_says_is_held_to_the_same():
    assert validate_files({"a/b": b"1"}, "ws/src", SMALL) == {"a/b": b"1"}
    nonsense = [None, [], {1: b""}, {"a": "text"}]
    strange = [{"../a": b""}, {"/etc/passwd": b""}, {"a//b": b""}, {"": b""}, {"a/..": b""}, {"a\0": b""}]
    much = [{"a/b/c/d": b""}, {"a": bytes(1001)}, {str(number): b"" for number in range(4)}]
    for files in nonsense:
        with pytest.raises(InvalidFiles, match=r"^ws/src could not be read\.$"):
            validate_files(files, "ws/src", SMALL)
    for files in strange + much:
        with pytest.raises(InvalidFiles):
            validate_files(files, "ws/src", SMALL)

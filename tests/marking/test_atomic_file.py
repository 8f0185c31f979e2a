import os

import pytest

from grader.marking.atomic_file import write_atomically


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_file_takes_the_place_of_another(tmp_path):
    target = tmp_path / "new" / "file.json"
    write_atomically(target, "first")
    write_atomically(target, b"second", mode=0o600)
    assert target.read_bytes() == b"second"
    assert os.stat(target).st_mode & 0o777 == 0o600
    assert names(target.parent) == ["file.json"]


def test_what_a_killed_writer_left_is_taken_over(tmp_path):
    (tmp_path / ".file.json.part").write_text("torn")
    write_atomically(tmp_path / "file.json", "whole")
    assert names(tmp_path) == ["file.json"]
    assert (tmp_path / "file.json").read_text() == "whole"


def test_where_it_fails_the_old_file_stays(tmp_path):
    (tmp_path / "file.json").mkdir()
    with pytest.raises(OSError, match="Is a directory"):
        write_atomically(tmp_path / "file.json", "new")
    assert names(tmp_path) == ["file.json"]

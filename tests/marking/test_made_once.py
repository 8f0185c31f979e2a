"""What workers share is made once, and again only if making it failed."""

from types import SimpleNamespace

import pytest

from tests.marking.made_once import made_once


@pytest.fixture
def workers(tmp_path, monkeypatch):
    """The factories of two workers of one run."""
    monkeypatch.setenv("PYTEST_XDIST_WORKER", "gw0")
    folders = [tmp_path / name for name in ("gw0", "gw1")]
    for folder in folders:
        folder.mkdir()
    return [SimpleNamespace(getbasetemp=lambda folder=folder: folder) for folder in folders]


def test_what_one_worker_has_made_the_others_take(workers):
    made = []

    def make(folder):
        made.append(folder)
        (folder / "file").write_text("made")

    folders = {made_once(worker, "class", make) for worker in workers}
    assert len(made) == len(folders) == 1
    assert [(folder / "file").read_text() for folder in folders] == ["made"]


def test_without_workers_it_is_among_the_run_s_own_folders(workers, monkeypatch):
    monkeypatch.setenv("PYTEST_XDIST_WORKER", "")
    folder = workers[0].getbasetemp()
    assert made_once(workers[0], "class", lambda made: None) == folder / "class"


def test_what_could_not_be_made_is_made_by_the_next_one(workers):
    def fail(folder):
        (folder / "half").touch()
        raise ValueError("no class")

    with pytest.raises(ValueError, match=r"^no class$"):
        made_once(workers[0], "class", fail)
    folder = made_once(workers[1], "class", lambda made: (made / "file").touch())
    assert [path.name for path in folder.iterdir()] == ["file"]

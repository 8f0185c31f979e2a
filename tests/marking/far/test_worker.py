from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import psutil
import pytest

from grader.marking.far.parcel import pack
from grader.marking.far.worker import Seat
from grader.marking.orders import Patience
from grader.marking.result import Result
from grader.marking.sandbox import Limits
from tests.marking.pool.assignment import hand_in, release

SECRET = "a secret of this test"


@pytest.fixture
def order(tmp_path) -> dict[str, Any]:
    """An order to mark a right submission."""
    task = hand_in(tmp_path / "ann", release(tmp_path / "02_two"))
    about = {"student": "ann", "assignment": "02_two", "key": task.key}
    how = {"run": "first", "unsafe": True, "secret": SECRET}
    most = {"patience": vars(Patience()), "limits": asdict(Limits())}
    return {**how, **most, "task": about, "submission": pack(task.folder), "release": pack(task.release)}


@pytest.fixture
def seat() -> Iterator[Seat]:
    seat = Seat()
    yield seat
    seat.close()


def test_a_seat_has_one_pool_which_ends_with_its_run(seat, order, tmp_path):
    before = set(psutil.Process().children(True))
    points = []
    for run in ("first", "first", "second"):
        kind, text = seat.mark({**order, "run": run}, tmp_path)
        points.append((kind, Result.from_json(text).points))
        assert len(set(psutil.Process().children()) - before) == 2
    assert points == [("marked", 23.0)] * 3
    assert sorted(path.name for path in tmp_path.iterdir()) == ["02_two", "ann"]
    seat.leave("first")
    assert len(set(psutil.Process().children()) - before) == 2
    seat.leave("second")
    assert set(psutil.Process().children(True)) == before


def test_a_run_that_is_over_is_not_begun_again(seat, order, tmp_path):
    before = set(psutil.Process().children(True))
    seat.leave("first")
    assert seat.mark(order, tmp_path) == ("failed", "RuntimeError: the run is over")
    assert set(psutil.Process().children(True)) == before


def test_nothing_is_raised_for_dask_would_log_the_secret(seat, order, tmp_path):
    assert seat.mark({**order, "limits": {"speed": 1}}, tmp_path) == (
        "failed",
        "TypeError: Limits.__init__() got an unexpected keyword argument 'speed'",
    )
    why = "TypeError: 'int' object is not iterable"
    assert seat.mark({**order, "release": 7}, tmp_path) == ("failed", why)


def test_a_machine_without_a_sandbox_says_so(seat, order, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", "")
    kind, why = seat.mark({**order, "unsafe": False}, tmp_path)
    assert kind == "unfit"
    assert why.startswith("Marking runs students' code in a sandbox made by bubblewrap, and this machine ")

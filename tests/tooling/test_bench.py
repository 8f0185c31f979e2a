"""The benchmarks compare like with like, and say so when they can't."""
import importlib
import os

import pytest

from tests.bench import __main__ as bench
from tests.bench import pace, report, scenario, startup


def test_the_engine_and_rclpys_own_executor_do_the_same_work(monkeypatch):
    monkeypatch.setattr(scenario, "SECONDS", 6)
    done = scenario.lockstep()
    assert (done["clocks"], done["scans"], done["odoms"], done["commands"]) == (120, 120, 120, 60)
    with pytest.MonkeyPatch.context() as on_any_core:
        on_any_core.setattr(os, "sched_setaffinity", lambda pid, cores: None)
        assert done == scenario.apart()
        scenario._other_process().close()
        scenario._other_process.cache_clear()
    assert done == scenario.stock(20)
    assert done | {"clocks": 600} == scenario.stock(100)


def test_a_run_that_ends_early_is_not_measured():
    with pytest.raises(RuntimeError) as stopped:
        report.avoider_run(world="yard", seconds=5, until=lambda recording: recording.stamp > 1)
    assert str(stopped.value) == "the run should last 5 s. The goal was reached at t = 1.05 s."


def test_marks_that_are_not_full_are_no_pace(monkeypatch, tmp_path):
    (tmp_path / "course").mkdir()
    for name in ("solutions", "exercises"):  # the starter in place of the solution
        (tmp_path / "course" / name).symlink_to(pace.COURSE / "exercises")
    monkeypatch.setattr(pace, "COURSE", tmp_path / "course")
    monkeypatch.setattr(pace, "STUDENTS", 1)
    with pytest.raises(RuntimeError) as stopped:
        pace.paced("01_nodes", tmp_path)
    assert str(stopped.value) == "the solutions of 01_nodes did not get all points"


def test_a_fresh_process_gives_its_figures():
    figures = report.fresh("tests.bench.startup", next(iter(startup.VARIANTS)))
    assert len(figures) == 3
    assert all(seconds > 0 for seconds in figures)


def test_an_unknown_benchmark_is_named(capsys):
    assert bench.main(["speed"]) == 2
    assert capsys.readouterr().out == (
        "There is no benchmark 'speed'; "
        "the benchmarks are scenario, startup, world, transforms, repeats, digests, "
        "marking, pace, view, navigator, localized, capstone, hub.\n"
    )


@pytest.mark.parametrize("name", bench.PARTS + bench.ON_REQUEST)
def test_a_benchmark_says_what_it_measures_and_runs_alone(name):
    module = importlib.import_module(f"tests.bench.{name}")
    assert module.__doc__.strip()
    assert callable(module.main)


def test_a_table_is_aligned(capsys):
    report.table(["", "s"], [["engine", "0.45"], ["stock", "12"]])
    assert capsys.readouterr().out == "           s\nengine  0.45\nstock     12\n"

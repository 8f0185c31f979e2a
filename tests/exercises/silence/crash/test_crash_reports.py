"""Reports of programs that an error ended, and what can be read in them."""

from pathlib import Path

import pytest

from grader.exercises.silence.crash.crash_reports import BODIES, ENDED, HELPER_FILE, WORKSPACE, crash_reports
from tests.exercises.silence.crash.students import FromTheTop, Reader

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("seed", range(5))
def test_each_text_has_the_place_and_the_error_that_two_readers_find(seed):
    reports = crash_reports(seed)
    assert len({report.text for report in reports}) == len(BODIES)
    for report in reports:
        wanted = f"{report.place} {report.error}"
        for reader in (Reader, FromTheTop):
            place, error = reader.cause(reader.__new__(reader), report.text).split()
            assert f"{place} {error.rpartition('.')[2]}" == wanted


@pytest.mark.parametrize("seed", range(5))
def test_the_paths_are_those_of_a_robot(seed):
    for report in crash_reports(seed):
        paths = [line.split('"')[1] for line in report.text.splitlines() if line.startswith('  File "')]
        assert {"/".join(path.split("/")[:3]) for path in paths} <= {"/home/you", "/opt/ros", "/usr/lib"}
        assert str(ROOT) not in report.text


def test_the_lines_of_the_programs_are_shown():
    text = next(report.text for report in crash_reports(1) if report.place.startswith(HELPER_FILE))
    assert f'File "{WORKSPACE}' in text
    assert "\n    rclpy.spin(" in text
    assert "\n    return whole / len(parts)\n" in text


def test_each_report_has_its_difficulty():
    reports = crash_reports(2)
    assert sum(report.lowest != report.place for report in reports) == 4
    assert [report.handled[0] for report in reports if report.handled] == ["KeyError"]
    assert sum(report.place.startswith(HELPER_FILE) for report in reports) == 1
    assert any(report.text.endswith(ENDED) for report in reports)
    assert all(report.place not in report.above for report in reports)


def test_equal_seeds_give_equal_reports_and_others_do_not():
    first = crash_reports(3)
    crash_reports.cache_clear()
    assert crash_reports(3) == first
    assert crash_reports(4) != first

"""What is nearly right in a package's files is corrected, and nothing else."""

from functools import partial

import pytest

from grader.exercises.launching.patrol.answers import FAULTS, FILES, with_one_fault_less
from grader.workspace.near_misses import commas, corrected, entry_points, executables, judge_only

SETUP = "station/setup.py"
POINTS = "entry_points={{'console_scripts': ['sensor = station.sensor:{}', \"display = station.display:show\"]}}"


def setup(function="main"):
    text = POINTS.format(function) if function else POINTS.format("main").replace(":main", "")
    return {SETUP: text.encode(), "station/station/display.py": b"def show():\n    pass\n"}


@pytest.mark.parametrize("wrong", ["", "mian", "Main", "man"])
def test_an_entry_point_without_main_gets_it(wrong):
    assert corrected(setup(wrong), [entry_points]) == setup()


@pytest.mark.parametrize("other", ["main", "start", "system"])
def test_other_functions_stay(other):
    assert corrected(setup(other), [entry_points]) is None


def test_a_function_that_there_is_stays():
    files = setup("main_") | {"station/station/sensor.py": b"def main_():\n    pass\n"}
    assert corrected(files, [entry_points]) is None


def test_a_misspelt_command_gets_the_name_that_the_task_wants():
    files = {SETUP: setup()[SETUP].replace(b"'sensor", b"'sensro")}
    assert corrected(files, [partial(entry_points, commands=("sensor", "display"))])[SETUP] == setup()[SETUP]
    assert corrected(files, [partial(entry_points, commands=("radio",))]) is None


def test_a_launch_file_gets_the_command_that_the_package_has():
    launch = {"station/launch/all.launch.py": b'Node(executable="sensr"), Node(executable = \'other\')'}
    assert corrected(setup() | launch, [executables]) == setup() | {
        "station/launch/all.launch.py": b'Node(executable="sensor"), Node(executable = \'other\')'
    }


def broken(*faults):
    files = dict(FILES)
    for path, right, wrong in faults:
        files[path] = files[path].replace(right, wrong)
    return {path: text.encode() for path, text in files.items()}


@pytest.mark.parametrize("fault", FAULTS)
def test_the_last_of_the_faults_is_corrected(fault):
    assert corrected(broken(fault), [with_one_fault_less]) == broken()


def test_two_faults_and_none_are_left_as_they_are():
    assert corrected(broken(), [with_one_fault_less]) is None
    assert corrected(broken(*FAULTS[:2]), [with_one_fault_less]) is None


def test_a_correction_that_students_do_not_have_corrects_nothing_there():
    name = "grader.exercises.launching.patrol.answers"
    assert corrected(broken(FAULTS[0]), [judge_only(f"{name}:with_one_fault_less")]) == broken()
    assert corrected(broken(FAULTS[0]), [judge_only(f"{name}_of_students:with_one_fault_less")]) is None


COMPLETE = """\
from glob import glob
setup(
    name='station',
    data_files=[
        ('share/station', ['package.xml']),
        ('share/station/launch', glob('launch/*')),
    ],
    entry_points={'console_scripts': ['sensor = station.sensor:main', 'display = station.display:show']},
)
"""


@pytest.mark.parametrize("before", ["name='station'", "['package.xml'])", "glob('launch/*')),\n    ]", "sensor:main'"])
def test_a_comma_that_is_missing_is_put_in(before):
    assert f"{before}," in COMPLETE
    incomplete = {SETUP: COMPLETE.replace(f"{before},", before).encode()}
    assert corrected(incomplete, [commas]) == {SETUP: COMPLETE.encode()}


@pytest.mark.parametrize("text", [COMPLETE, COMPLETE.replace("setup(", "setup(("), "\x00"])
def test_where_no_comma_is_missing_none_is_put_in(text):
    assert corrected({SETUP: text.encode()}, [commas]) is None

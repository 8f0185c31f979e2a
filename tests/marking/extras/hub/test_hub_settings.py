"""What class/hub.toml may hold, and what is said of everything else."""
import tomllib
from pathlib import Path

import pytest

from grader.marking.errors import CourseError
from grader.marking.extras.hub.hub_settings import (
    TEMPLATE,
    HubCourse,
    ServerSettings,
    UserLimits,
    read_settings,
    write_template,
)

COURSE = '[courses.ros2]\nteachers = ["ines"]\nstudents = ["alice", "bob"]\n'
NAMES = "write 2 to 24 of a-z, 0-9, - and _, the first one a letter."
WRONG = {
    "": "there is no course: write a table such as [courses.ros2].",
    "courses = 1": "there is no course: write a table such as [courses.ros2].",
    "[courses]\nros2 = 1": "courses.ros2 is 1; write a table [courses.ros2].",
    "[courses.ros2]\nstudents = []": "courses.ros2.teachers is missing.",
    "[courses.ros2]\nteachers = 'ines'": "courses.ros2.teachers is 'ines'; write a tuple.",
    "[courses.ros2]\nteachers = ['Ines']": f"the name 'Ines' can't be used; {NAMES}",
    "[courses.'../x']\nteachers = []": f"the name '../x' can't be used; {NAMES}",
    COURSE + "[course.b]": "course is not a known key; the keys are server, limits, courses.",
    COURSE + "color = 1": "courses.ros2.color is not a known key; the keys are teachers, students.",
    COURSE + "[server]\nport = 70000": "server.port is 70000; write a whole number from 1 to 65535.",
    COURSE + "[server]\nfolder = 'hub'": "server.folder is 'hub'; write an absolute path.",
    COURSE + "[server]\nfolder = '/tmp/hub'": "server.folder is in /tmp, and each user has another /tmp: change it.",
    COURSE + "[server]\nkey = '/k'": "server.certificate and server.key belong together: write both or none.",
    COURSE + "[limits]\nmemory_gb = 0.1": "limits.memory_gb is 0.1; write a number from 0.5 to 1000 (GB).",
    COURSE + "[limits]\nprocesses = 1.5": "limits.processes is 1.5; write a whole number from 50 to 100000.",
    COURSE + "[limits]\ncpus = 0": "limits.cpus is 0; write a number from 0.1 to 1000 (cores).",
    COURSE + "[courses.other]\nteachers = []\nstudents = ['bob']": (
        "bob is a student of ros2 and other: one course each."
    ),
    COURSE + "[courses.other]\nteachers = ['bob']": "bob is a teacher, and a student of ros2: use two names.",
    "[courses.other]\nteachers = ['grader-other']": (
        "grader-other is the user who marks the course, and can't be a teacher or student."
    ),
}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "hub.toml"


@pytest.mark.parametrize(("text", "reason"), WRONG.items())
def test_a_wrong_value_is_named_with_what_to_write(file, text, reason):
    file.write_text(text)
    with pytest.raises(CourseError) as raised:
        read_settings(file)
    assert str(raised.value) == f"{file}: {reason}"


def test_a_missing_file_and_one_that_is_no_toml_are_named(file):
    with pytest.raises(CourseError) as raised:
        read_settings(file)
    assert str(raised.value) == f"{file} can't be read (No such file or directory): `make hub` writes one"
    file.write_text("port = = 1")
    with pytest.raises(CourseError, match=r"hub\.toml is not a TOML file: Invalid value"):
        read_settings(file)


def test_the_template_has_every_setting_with_its_default(tmp_path):
    file = write_template(tmp_path)
    data = tomllib.loads(TEMPLATE.read_text())
    assert ServerSettings(**data["server"]) == ServerSettings()
    assert UserLimits(**data["limits"]) == UserLimits()
    assert read_settings(file).courses == {"ros2": HubCourse(())}
    file.write_text("mine")
    assert write_template(tmp_path).read_text() == "mine"


def test_each_user_has_a_domain_of_their_own_that_ros_can_use(file):
    file.write_text(COURSE.replace('"alice"', ", ".join(f'"s{number}"' for number in range(99))))
    settings = read_settings(file)
    users = [*settings.students, *settings.teachers]
    assert sorted(map(settings.domain, users)) == list(range(1, 102))
    assert settings.domain("someone-else") == 0


def test_paths_are_those_of_the_folder(file):
    file.write_text(COURSE + "[server]\nfolder = '/hub'")
    settings = read_settings(file)
    assert (settings.students, settings.teachers) == ({"alice": "ros2", "bob": "ros2"}, ["ines"])
    assert str(settings.inbox("bob")) == "/hub/exchange/students/ros2/bob"
    assert str(settings.course_folder("ros2")) == "/hub/courses/ros2/course"

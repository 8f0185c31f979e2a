"""What a hub installs for students, and what it never does."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from grader.marking.errors import CourseError
from grader.marking.extras.hub import hub_installation as installation
from grader.marking.extras.hub.hub_settings import HubCourse, HubSettings, ServerSettings, UserLimits
from grader.marking.release import handout
from tests.marking.tiny import ROOT


def test_students_get_the_handout_and_what_the_hub_needs():
    added = dict(installation._added(ROOT))
    assert set(added) - set(handout.contents(ROOT)) == set(added)
    assert {name.split("/")[0] for name in added} == {".ci", "grader", "jupyter"}
    assert {"jupyter/hub/jupyterhub_config.py", "grader/marking/extras/hub/hub.toml", ".ci/hub.lock"} <= set(added)


def test_a_step_that_fails_is_named_with_its_folder(tmp_path):
    with pytest.raises(CourseError) as raised:
        installation._run(["false", "x"], tmp_path, {"PATH": "/usr/bin:/bin"})
    assert str(raised.value) == f"`false x` failed in {tmp_path}: the reason is above"


def test_nbgrader_reads_the_settings_that_are_written_for_teachers(tmp_path):
    settings = HubSettings(
        ServerSettings(folder=str(tmp_path)), UserLimits(), {"robots": HubCourse(("ines",), ("alice",))}
    )
    for name in ("nbgrader_config.py", "class/hub_config.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / "nbgrader_config.py").write_text((ROOT / "nbgrader_config.py").read_text())
    (tmp_path / "class" / "hub_config.py").write_text(installation._exchange_settings(settings, "robots"))
    code = """
from pathlib import Path
from grader.marking.gradebook.course import Course
from nbgrader.exchange import ExchangeFactory
course = Course(Path.cwd())
factory = ExchangeFactory(config=course.app.config)
lists = [factory.exchange, factory.collect, factory.release_feedback, factory.release_assignment]
print(course.name, course.app.config.Exchange.root, course.app.config.Inboxes.folder)
print([each.__name__ for each in lists], factory.Collect(coursedir=course.directory).check_owner)
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, text=True, capture_output=True, check=True)
    exchange = tmp_path / "exchange"
    assert done.stdout.splitlines() == [
        f"robots {exchange / 'courses' / 'robots'} {exchange / 'students' / 'robots'}",
        "['Exchange', 'CollectFromInboxes', 'ReleaseFeedbackToInboxes', 'ReleaseAssignment'] False",
    ]


def test_the_lock_has_what_pyproject_names():
    lock = Path(ROOT, ".ci", "hub.lock").read_text()
    assert "\njupyterhub==" in lock and "\njupyterhub-idle-culler==" in lock


def test_a_student_s_server_has_the_extensions_of_make_lab_and_the_list_of_assignments(tmp_path):
    code = """
from jupyter_server.serverapp import ServerApp
app = ServerApp()
app.load_config_file()
print(sorted(name for name, enabled in app.jpserver_extensions.items() if enabled))
"""
    jupyter = shutil.copytree(ROOT / "jupyter", tmp_path / "course" / "jupyter")
    places = {"JUPYTER_CONFIG_PATH": f"{jupyter / 'hub'}{os.pathsep}{jupyter}", "HOME": str(tmp_path)}
    places = os.environ | places | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=places, text=True, capture_output=True)
    shown = ["grader.marking.extras.hub.submit_button", "lab_addresses"]
    shown += ["nbgrader.server_extensions.assignment_list", "start_page"]
    assert done.stdout.splitlines()[-1] == str(shown)

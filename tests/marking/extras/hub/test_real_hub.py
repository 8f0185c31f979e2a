"""A day of a class on a real hub, and a student who tries to reach what belongs to others."""
import json
from collections.abc import Iterator
from pathlib import Path

import pytest
import requests

from grader.marking.extras.hub.hub_settings import UserLimits
from grader.marking.extras.hub.leftovers import is_process_of
from tests.marking.extras.hub.hub_client import HubClient
from tests.marking.extras.hub.real_hub import COURSE, RealHub, real_hub, reason_to_skip

ASSIGNMENT = "01_nodes"
NOTEBOOK = f"exercises/{ASSIGNMENT}/nodes.ipynb"
LIMITS = UserLimits(memory_gb=1.0, processes=300, cpus=0.5)
ANSWERS = Path(__file__).parents[4] / "solutions" / ASSIGNMENT / "nodes.ipynb"
ALICE, BOB, CAROL = "hubtest-00", "hubtest-01", "hubtest-02"

pytestmark = [pytest.mark.soak, pytest.mark.skipif(bool(reason_to_skip()), reason=reason_to_skip())]


@pytest.fixture(scope="module")
def hub() -> Iterator[RealHub]:
    with real_hub(3, LIMITS) as running:
        yield running


@pytest.fixture(scope="module")
def students(hub: RealHub) -> dict[str, HubClient]:
    return {name: hub.client(name) for name in hub.settings.students}


@pytest.fixture(scope="module")
def marked(hub: RealHub, students: dict[str, HubClient]) -> str:
    """All handed in: one student the answers, the others what they got. What `mark` printed."""
    hub.as_grader("sh", "-c", "umask 077; echo a-secret-of-the-class > .secret")
    hub.as_grader("nbgrader", "release_assignment", ASSIGNMENT)
    answers = json.loads(ANSWERS.read_text())
    for name, student in students.items():
        if name == ALICE:
            student.save_notebook(NOTEBOOK, answers)
        answer = student.submit(COURSE, ASSIGNMENT)
        assert answer["success"], answer
    assert "cheating" not in hub.as_grader("nbgrader", "collect", ASSIGNMENT)
    table = hub.as_grader("python", "-m", "grader", "mark", ASSIGNMENT)
    hub.as_grader("nbgrader", "release_feedback", ASSIGNMENT)
    return table


def test_a_wrong_password_and_a_user_who_is_not_in_the_settings_are_refused(hub):
    assert not HubClient(hub.address, ALICE, "wrong").logged_in
    assert not HubClient(hub.address, "root", "wrong").logged_in


def test_a_student_s_files_are_in_the_home_and_the_course_is_read_only(hub, students):
    kernel = students[BOB].start_kernel("course/01_nodes/lesson.ipynb")
    reported = kernel.run(
        "import os, sim; print(os.getcwd(), oct(os.umask(0o77)), os.access(os.path.dirname(sim.__file__), os.W_OK),"
        "os.environ['ROS_DOMAIN_ID'])"
    )
    kernel.stop()
    assert reported["text"].split() == [f"/home/{BOB}/ros2-course/course/01_nodes", "0o77", "False", "2"]


def test_a_class_hands_in_is_marked_and_each_reads_only_the_own_feedback(marked, students):
    points = {line.split()[0]: line.split()[7] for line in marked.splitlines() if line.startswith("hubtest")}
    assert points == {ALICE: "100", BOB: "0", CAROL: "0"}
    for name, student in students.items():
        attempts = student.fetch_feedback(COURSE, ASSIGNMENT)["value"][-1]["submissions"]
        folder = attempts[0]["local_feedback_path"]
        page = student.get(f"api/contents/{folder}/nodes.html").json()["content"]
        assert [other for other in students if other in page] == [name]


def test_a_teacher_marks_in_the_browser_and_a_student_is_refused(hub, marked, students):
    for teacher in hub.settings.teachers:
        session = HubClient(hub.address, teacher, hub.passwords[teacher]).session
        page = session.get(f"{hub.address}/services/{COURSE}/")
        assert page.url == f"{hub.address}/services/{COURSE}/formgrader/manage_assignments"
        rows = session.get(f"{hub.address}/services/{COURSE}/formgrader/api/submissions/{ASSIGNMENT}").json()
        assert {row["student"]: row["score"] for row in rows} == {ALICE: 100, BOB: 0, CAROL: 0}
    refused = students[BOB].session.get(f"{hub.address}/services/{COURSE}/formgrader/api/submissions/{ASSIGNMENT}")
    assert refused.status_code == 403


def secrets_of_others(hub: RealHub) -> list[tuple[str, str]]:
    """What a thief would like to have: kinds and paths."""
    settings, home = hub.settings, Path("/home", ALICE)
    inbox, course = settings.inbox(ALICE) / COURSE, settings.course_folder(COURSE)
    found = [
        ("home", home / "ros2-course" / NOTEBOOK),
        ("submission", next(inbox.glob("inbound/*/nodes.ipynb"))),
        ("submission", next(inbox.glob("inbound/*/submission_secret.txt"))),
        ("collected", next((settings.exchange(COURSE) / COURSE / "inbound").glob(f"{ALICE}+*/nodes.ipynb"))),
        ("feedback", next(inbox.glob("feedback/*.html"))),
        ("kernel", next(settings.runtime(ALICE).glob("kernel-*.json"))),
        ("kernel", next(settings.runtime(ALICE).glob("kernel-*-ipc-1"))),
        ("certificate", next(settings.certificates(ALICE).glob("*.key"))),
        ("teacher", course / ".secret"),
        ("teacher", course / "class" / "gradebook.db"),
        ("teacher", course / "solutions" / ASSIGNMENT / "nodes.ipynb"),
        ("hub", settings.folder / "passwords.csv"),
        ("hub", settings.folder / "hub" / "jupyterhub.sqlite"),
        ("hub", settings.folder / "hub" / "jupyterhub_cookie_secret"),
    ]
    return [(kind, str(path)) for kind, path in found]


def test_no_student_reaches_what_belongs_to_another(hub, marked, students):
    alice = students[ALICE].start_kernel(NOTEBOOK)
    alice.run("import tempfile; names = [tempfile.mkstemp(dir=each) for each in ('/tmp', '/var/tmp', '/dev/shm')]")
    alice.begin("import time\nfor number in range(10_000):\n    print('secret', number)\n    time.sleep(0.01)")
    first = hub.settings.server.port
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    every = [int(row[1].split(":")[1], 16) for row in rows if row[3] == "0A" and int(row[7]) >= 1000]
    program = Path(__file__).with_name("thief.py").read_text()
    places = secrets_of_others(hub)
    processes = [int(path.name) for path in Path("/proc").glob("[0-9]*")]
    processes = [process for process in processes if is_process_of(process, ALICE)]
    inside = f"PLACES, PORTS, PROCESSES = {places}, {sorted({*every, first + 1, first + 2})}, {processes}"
    program = program.replace("PLACES, PORTS, PROCESSES = [], [], []", inside)
    thief = students[BOB].start_kernel(NOTEBOOK)
    report = thief.run(program)
    gone = [path for _, path in places if not Path(path).exists()]
    thief.stop()
    alice.stop()
    assert "kernel: connect: denied" in report["text"]
    assert "process: kill: denied" in report["text"]
    assert "process: list: only the own ones []" in report["text"]
    assert report["status"] == "ok", report["text"]
    lines = report["text"].splitlines()
    assert len([line for line in lines if line.startswith(("home: ", "submission: "))]) == 27
    assert [line for line in lines if "DONE" in line] == []
    assert gone == []


def test_the_installation_is_written_by_root_only(hub, students):
    kernel = students[BOB].start_kernel(NOTEBOOK)
    program = (
        "import os\nfor place, folders, files in os.walk(FOLDER):\n"
        "    for name in ['.', *files]:\n"
        "        path = os.path.join(place, name)\n"
        "        if os.access(path, os.W_OK) and not os.path.islink(path): print(path)"
    )
    reported = kernel.run(program.replace("FOLDER", repr(str(hub.settings.installation))))
    kernel.stop()
    assert (reported["status"], reported["text"]) == ("ok", "")


def test_servers_of_others_are_closed_with_the_own_login_and_with_the_own_token(hub, students):
    session = students[BOB].session
    for path in ("lab", "api/contents", "api/kernels", "api/terminals"):
        assert session.get(f"{hub.address}/user/{ALICE}/{path}").status_code in (403, 404), path
    kernel = students[BOB].start_kernel(NOTEBOOK)
    token = kernel.run("import os; print(os.environ['JUPYTERHUB_API_TOKEN'])")["text"].strip()
    kernel.stop()
    headers = {"Authorization": f"token {token}"}
    for path in (f"hub/api/users/{ALICE}", f"user/{ALICE}/api/contents", f"services/{COURSE}/api/contents"):
        assert requests.get(f"{hub.address}/{path}", headers=headers).status_code in (403, 404), path


def test_a_kernel_that_exhausts_memory_ends_and_the_server_and_the_others_go_on(hub, students):
    kernel = students[CAROL].start_kernel(NOTEBOOK)
    ended = kernel.run("data = []\nwhile True: data.append(bytearray(50_000_000))")
    assert ended["status"] in ("dead", "error"), ended
    assert students[CAROL].get("api/status").ok
    other = students[ALICE].start_kernel(NOTEBOOK)
    assert other.run("print(6 * 7)")["text"] == "42\n"
    other.stop()


def test_processes_end_at_the_limit_and_others_start_their_own(hub, students):
    kernel = students[CAROL].start_kernel(NOTEBOOK)
    reported = kernel.run(
        "import subprocess\nstarted = []\ntry:\n"
        "    for number in range(1000): started.append(subprocess.Popen(['sleep', '60']))\n"
        "except OSError as error: print(type(error).__name__, len(started) < 300)\n"
        # A process that has ended counts until its parent waits for it: the next test could start none.
        "for each in started: each.kill()\n"
        "for each in started: each.wait()"
    )
    assert reported["text"] == "BlockingIOError True\n"
    kernel.stop()


BUSY = r"""
import resource, subprocess, sys, time
spin = "import time; end = time.monotonic() + 4\nwhile time.monotonic() < end: pass"
begin = time.monotonic()
for each in [subprocess.Popen([sys.executable, "-c", spin]) for _ in range(3)]: each.wait()
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print((used.ru_utime + used.ru_stime) / (time.monotonic() - begin))
"""


def test_computing_time_ends_at_the_limit(hub, students):
    kernel = students[CAROL].start_kernel(NOTEBOOK)
    cores = float(kernel.run(BUSY)["text"])
    kernel.stop()
    assert cores < 1.1 * LIMITS.cpus

"""JupyterLab's own terminals, with what the lessons say one should type there."""

import pytest

from grader.exercises.packages.session.watchman_package import write_watchman
from sim.ros2.typed_lines import lines_of
from sim.ros2.typed_session import CTRL_C
from tests.exercises.packages.session.students import RIGHT
from tests.sim.standalone.programs import free_domain
from tests.tooling.test_packages_on_a_robot import write_workspace

pytestmark = [pytest.mark.browser, pytest.mark.soak]  # builds a package, and drives in real time

TEXT = """() => {
    const buffer = window.jupyterapp.shell.currentWidget.content._term.buffer.active;
    return [...Array(buffer.length).keys()].map(
        row => buffer.getLine(row).translateToString(true)).join('\\n');
}"""

FOCUSED = "() => window.jupyterapp.shell.currentWidget.node.contains(document.activeElement)"
SEEN = "ros2 node list > seen"
UNTIL_BOTH_ARE_SEEN = f"until {SEEN}; grep -q /robot seen && grep -q /stopper seen; do :; done; cat seen"


def terminal(lab):
    """Open one, and wait for its prompt; return its id in JupyterLab."""
    lab.command("terminal:create-new")
    lab.page.wait_for_function("() => window.jupyterapp.shell.currentWidget?.content?._term")
    lab.page.wait_for_function(f"() => ({TEXT})().trim()")
    lab.page.wait_for_function(FOCUSED)
    return lab.page.evaluate("window.jupyterapp.shell.currentWidget.id")


def turn_to(lab, opened):
    """Show a terminal that is open, by its id, and wait until it has the focus."""
    lab.page.evaluate("id => window.jupyterapp.shell.activateById(id)", opened)
    lab.page.wait_for_function(
        f"id => window.jupyterapp.shell.currentWidget?.id === id && ({FOCUSED})()", arg=opened
    )


def types(lab, line):
    lab.page.keyboard.type(line)
    lab.page.keyboard.press("Enter")


def shows(lab, words):
    """Wait until the terminal that shows has these words, and return its text."""
    lab.page.wait_for_function(f"words => ({TEXT})().trim().includes(words)", arg=words)
    return lab.page.evaluate(TEXT)


def test_the_package_of_lesson_11_is_built_and_run_in_terminals(lab, students_folder):
    folder = students_folder / "course" / "11_packages"
    write_workspace(folder)
    domain = free_domain()
    lab.open("course/11_packages/lesson.ipynb")

    terminal(lab)
    types(lab, f"python -m sim --world room --domain {domain} --port 0")
    robot = shows(lab, "Ctrl-C")
    assert "http://localhost:" in robot

    terminal(lab)
    types(lab, f"cd {folder}/ws && colcon build --packages-select my_robot && cd ..")
    shows(lab, "1 package finished")
    types(lab, f"export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST")
    types(lab, "ros2 run my_robot stopper")
    shows(lab, "Package 'my_robot' not found")
    types(lab, "source ws/install/setup.bash")
    types(lab, "ros2 run my_robot stopper")
    shows(lab, "I stop 0.5 m before a wall")

    terminal(lab)
    types(lab, f"export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST")
    types(lab, "ros2 topic echo /cmd_vel --once --field linear.x")
    shows(lab, "---")
    # On a busy machine they don't find each other at once.
    types(lab, UNTIL_BOTH_ARE_SEEN)
    shows(lab, "/robot\n/stopper")
    lab.screenshot("terminals")


# What a line shows once it has done its work: typing goes on then.
DONE = {
    "colcon build": "1 package finished",
    "ros2 node info": "Action Clients",
    "ros2 topic echo": "---",
    "ros2 topic pub": "publishing #1",
    "ros2 service call": "success=True",
    "ros2 param set": "Set parameter successful",
}


def test_a_graded_session_of_lesson_11_is_typed_in_terminals(lab, students_folder):
    """The lines that earn all points in marking do the same here, with a robot that is a process."""
    folder, domain = students_folder / "exercises" / "11_packages", free_domain()
    write_watchman(folder / "ws")
    lab.open("course/11_packages/lesson.ipynb")
    opened = {}
    for line in lines_of(RIGHT):
        if line.terminal not in opened:
            opened[line.terminal] = terminal(lab)
            types(lab, f"cd {folder}")
        turn_to(lab, opened[line.terminal])
        if CTRL_C.fullmatch(line.text):
            lab.page.keyboard.press("Control+c")
            continue
        words = line.text.replace("ROS_DOMAIN_ID=42", f"ROS_DOMAIN_ID={domain}")
        if words.startswith("python"):
            types(lab, f"{words} --domain {domain} --port 0")
            shows(lab, "Ctrl-C")
            continue
        if words.startswith("ros2 node info"):
            types(lab, f"until {SEEN}; grep -q /watchman seen; do :; done")
        types(lab, f"clear; {words}")
        for begin, done in DONE.items():
            if words.startswith(begin):
                shows(lab, done)
    turn_to(lab, opened["3"])
    ended = f"{SEEN}; grep -q /robot seen && ! grep -q /watchman seen"
    types(lab, f"clear; until {ended}; do :; done; cat seen; echo all e''nded")
    assert "\n/watchman" not in shows(lab, "all ended")
    lab.screenshot("session")

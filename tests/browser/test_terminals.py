"""JupyterLab's own terminals, with what the lessons say one should type there."""

import pytest

from tests.sim.standalone.programs import free_domain
from tests.tooling.test_packages_on_a_robot import write_workspace

pytestmark = [pytest.mark.browser, pytest.mark.soak]  # builds a package, and drives in real time

TEXT = """() => {
    const buffer = window.jupyterapp.shell.currentWidget.content._term.buffer.active;
    return [...Array(buffer.length).keys()].map(
        row => buffer.getLine(row).translateToString(true)).join('\\n');
}"""

UNTIL_BOTH_ARE_SEEN = (
    "until ros2 node list > seen; grep -q /robot seen && grep -q /stopper seen; do :; done; cat seen"
)


def terminal(lab):
    """Open one, and wait for its prompt."""
    lab.command("terminal:create-new")
    lab.page.wait_for_function("() => window.jupyterapp.shell.currentWidget?.content?._term")
    lab.page.wait_for_function(f"() => ({TEXT})().trim()")


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

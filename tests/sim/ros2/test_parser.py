"""The parser imports the verbs of the command that is typed, and of no other."""

import subprocess
import sys
from pathlib import Path

import pytest

from sim.ros2.absent import absent_command, absent_option
from sim.ros2.discovery_options import discovery_options
from sim.ros2.parser import COMMANDS, load_group, make_parser

# Of each command and verb of ros2cli, rosbag2 and launch_ros, as in official.py.
OPTIONS = Path(__file__).with_name("options_of_jazzy.txt").read_text()
JAZZY = [line.split(":") for line in OPTIONS.splitlines()]
LOADED = """
import sys
sys.argv = ["ros2", *{arguments!r}]
from sim.ros2 import parser
parser.make_parser(typed=parser.typed_words())
print(*sorted(name for name in sys.modules if name.startswith("sim.ros2.verbs.")), "numpy" in sys.modules)
"""


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_of_a_command_is_that_of_its_verbs(name):
    assert load_group(name).help == COMMANDS[name][1]


@pytest.mark.parametrize(
    ("arguments", "modules"),
    [
        (["topic", "list"], "sim.ros2.verbs.topic False"),
        (["interface", "show"], "sim.ros2.verbs.interface False"),
        (["--help"], "False"),
    ],
)
def test_a_command_imports_its_own_verbs_alone(arguments, modules):
    code = LOADED.format(arguments=arguments)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == modules


def test_all_verbs_are_parsed_where_nothing_is_typed_yet():
    assert make_parser().parse_args(["topic", "echo", "/scan"]).topic_name == "/scan"


@pytest.mark.parametrize(("words", "options"), JAZZY, ids=[words for words, _ in JAZZY])
def test_each_option_of_jazzy_is_here_or_named(words, options):
    command, _, verb = words.partition(" ")
    found = load_group(command).verbs[verb]
    known = {name for each in (*found.arguments, *discovery_options(words)) for name in each.names}
    unknown = [name for name in options.split() if name not in known and not absent_option(words, name)]
    assert unknown == []


@pytest.mark.parametrize("words", ["component", "daemon", "multicast", "security", "bag burst"])
def test_each_command_of_jazzy_is_here_or_named(words):
    assert absent_command(words).startswith(f"`ros2 {words}` is not available here: ")

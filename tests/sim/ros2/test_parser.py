"""The parser imports the verbs of the command that is typed, and of no other."""

import subprocess
import sys

import pytest

from sim.ros2.parser import COMMANDS, load_group, make_parser

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

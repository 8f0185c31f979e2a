"""Programs that count the boxes of a depot: some are right in every order, the others are not.

The contract is in the assignment. The seed decides which programs a test is tried on, in which order, and
what their nodes, classes and attributes are called.
"""

import random
from string import Template
from typing import NamedTuple

from grader.exercises.systems.race_test.racy_depots import ANSWERS, NEGATIVE, RACY
from grader.exercises.systems.race_test.right_depots import RIGHT

RIGHT_ONES, RACY_ONES = 5, 8  # that a test is tried on
SHOWN = "lock", "no lock"  # the designs of the two programs in the notebook
HEAD = """\
import threading
import time
from collections import deque
from queue import SimpleQueue

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class $Depot(Node):
    def __init__(self):
        super().__init__("$node", start_parameter_services=False)
        self.$stock = 0
        self.$levels = self.create_publisher(Int32, "/stock", 100)
        self.$answers = self.create_publisher(Int32, "/taken", 100)
"""
TAIL = """

def main():
    started()
    rclpy.init()
    executor = $executor
    executor.add_node($Depot())
    executor.spin()
"""
NAMES = {
    "Depot": ("Depot", "Store", "Stockroom", "Storage", "Warehouse", "Shelf"),
    "stock": ("stock", "count", "boxes", "level", "there", "total"),
    "levels": ("levels", "stocks", "reports", "out", "states"),
    "answers": ("answers", "taken", "responses", "replies", "given"),
    "arrive": ("on_arrive", "arrived", "add", "receive", "incoming"),
    "take": ("on_take", "requested", "give", "hand_out", "outgoing"),
    "lock": ("lock", "mutex", "access", "guard", "own"),
    "waiting": ("waiting", "todo", "jobs", "inbox", "queue"),
    "serve": ("serve", "work", "carry_out", "process", "do"),
    "group": ("group", "shared", "mine", "side", "main_group"),
}


class Candidate(NamedTuple):
    """A program that a test is tried on. number: its name in verdicts. design: the name of its design."""

    number: int
    right: bool
    design: str
    source: str


def candidates(seed: int) -> list[Candidate]:
    """Return five of the right designs, and eight of the racy ones, in the order of a seed."""
    rng = random.Random(f"depots {seed}")
    always = NEGATIVE + ANSWERS
    others = [name for name in RACY if name not in (*SHOWN, *always)]
    chosen = [(True, name) for name in rng.sample(list(RIGHT), RIGHT_ONES)]
    chosen += [(False, name) for name in (*always, *rng.sample(others, RACY_ONES - len(always)))]
    rng.shuffle(chosen)
    return [
        Candidate(number, right, name, source_of((RIGHT if right else RACY)[name], rng))
        for number, (right, name) in enumerate(chosen, 1)
    ]


def shown(right: bool) -> str:
    """Return the source of the notebook's right or racy program."""
    locked, unlocked = SHOWN
    return source_of(RIGHT[locked] if right else RACY[unlocked], random.Random("the notebook's"))


def source_of(design: str, rng: random.Random) -> str:
    """Return a program's source, with names that are drawn."""
    first, _, rest = design.partition("\n")
    executor = first.removeprefix("# ")
    names = {name: rng.choice(choices) for name, choices in NAMES.items()}
    node = f"{rng.choice('abcdefghkmnprstuvwxyz')}{rng.randrange(1000, 10000)}"
    names |= {"node": node, "executor": executor}
    return Template(HEAD + rest + TAIL).substitute(names)

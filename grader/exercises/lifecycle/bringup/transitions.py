"""The transitions that a bringup has requested, and the states that they led to."""

from __future__ import annotations

import math
from typing import NamedTuple

from grader.checks import Missed
from grader.exercises.lifecycle.bringup.managed_nodes import NODES
from grader.responses import EDGE
from sim.evidence import Call, Recording, Seconds

FINALIZED, UNCONFIGURED, INACTIVE, ACTIVE = range(4)  # each needs more undoing than the one before it
STATES = ("finalized", "unconfigured", "inactive", "active")
LABELS = {1: "configure", 2: "cleanup", 3: "activate", 4: "deactivate",
          5: "shutdown", 6: "shutdown", 7: "shutdown"}  # fmt: skip
RESULTS = {"configure": INACTIVE, "cleanup": UNCONFIGURED, "activate": ACTIVE, "deactivate": INACTIVE,
           "shutdown": FINALIZED}  # fmt: skip
UP, DOWN = ("configure", "activate"), ("deactivate", "cleanup", "shutdown")
REVERSE = ("Go through reversed(NODES): what uses the others ends first. And await each response before you "
           "request the next transition.")


class Step(NamedTuple):
    """A transition that the student's program requested from a node."""

    node: str
    label: str
    requested: Seconds
    answered: Seconds  # infinity without an answer
    success: bool

    @property
    def text(self) -> str:
        """Return it as "configure of /sensor requested at 0.2 s"."""
        return f"{self.label} of /{self.node} requested at {self.requested:.3g} s"


def steps(run: Recording, *labels: str) -> list[Step]:
    """Return the requests for these transitions, or for all, in the order in which they were sent."""
    made = [_step(node, call) for node in NODES for call in run.calls_of(f"/{node}/change_state")
            if call.requested is not None and not call.requested_by_course]
    return sorted((step for step in made if not labels or step.label in labels), key=lambda it: it.requested)


def _step(node: str, call: Call) -> Step:
    wanted, answered = call.request.transition, math.inf if call.answered is None else call.answered
    label = wanted.label or LABELS.get(wanted.id, f"transition {wanted.id}")
    return Step(node, label, call.requested or 0.0, answered, bool(call.response and call.response.success))


def state(run: Recording, node: str, stamp: Seconds) -> int:
    """Return the state of a node at a time, which results from the transitions that have succeeded."""
    done = [step for step in steps(run) if step.node == node and step.success]
    past = sorted((step.answered, RESULTS.get(step.label)) for step in done if step.answered <= stamp + EDGE)
    return past[-1][1] if past and past[-1][1] is not None else UNCONFIGURED


def require_reverse(run: Recording, begin: Seconds) -> None:
    """Raise Missed unless the nodes are shut down in reverse order, from a time on, and all of them."""
    for step in steps(run, *DOWN):
        for later in NODES[NODES.index(step.node) + 1 :]:
            other = state(run, later, step.requested)
            if step.requested >= begin - EDGE and step.success and other > RESULTS[step.label]:
                raise Missed(f"/{later} shut down before /{step.node}",
                             f"{step.text}, while /{later} was {STATES[other]}", REVERSE)  # fmt: skip
    for node in reversed(NODES):
        last = state(run, node, math.inf)
        if last != FINALIZED:
            guess = "Request the transition shutdown from each node: every state has it, even unconfigured."
            expected = f"/{node} finalized at the end of the run"
            raise Missed(expected, STATES[last], guess=guess, unsafe=last == ACTIVE and node == NODES[-1])

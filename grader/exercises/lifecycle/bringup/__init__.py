"""A bringup: it takes three lifecycle nodes to active, tries again, gives up, and shuts them down."""

import itertools

from grader.checks import Missed, course_calls, hinting, logs, offers, wrong_response
from grader.checks.services import call_text, has_client, is_success
from grader.exercise import Exercise, Scenario
from grader.exercises.lifecycle.bringup.managed_nodes import (
    NODES,
    SHUTDOWN,
    interrupted,
    never_active,
    never_configured,
    robot,
)
from grader.exercises.lifecycle.bringup.transitions import (
    ACTIVE,
    DOWN,
    INACTIVE,
    STATES,
    UP,
    Step,
    require_reverse,
    state,
    steps,
)
from grader.responses import EDGE
from grader.variants import Variants
from sim.evidence import Recording, Seconds

__all__ = ["bringup", "robot"]

FAILED = ("The response's success was False, so the node is still in its old state. Check success, and "
          "request the transition again before you turn to the next node.")
EARLY = ("call_async returns at once, and the transition takes a moment. Wait for its response, as in "
         "`response = await client.call_async(request)`, before you request the next one.")
ORDER = "Go through NODES in their order, first with configure for all three, then with activate."
AGAIN = "While success is False, request the same transition again: at most {} times in all."
END = "Count the requests: after {} failures, return without requesting anything else but shutdown."
INTERRUPTED = ("It was called while the bringup was waiting for a response: shut down in this case, too, and "
               "don't take that response for the one to your next request.")

bringup = Exercise("bringup", "Bring up a robot, and shut it down", may_end=True, scenarios=[
    Scenario("room", 12, 1, robot, name="recovers"),
    Scenario("room", 12, 2, robot, name="recovers"),
    Scenario("room", 8, 1, never_configured, name="broken"),
    Scenario("room", 8, 5, never_active, name="broken"),
    Scenario("room", 6, 3, interrupted, name="interrupted"),
], variants=Variants(
    {"tries": (3, 4, 5), "word": ("three", "four", "five"), "last": ("third", "fourth", "fifth")},
    texts=("at most **{word} times**", "the {last} time", "up to {word} times", "failed {word} times",
           "range({tries})", "the {last} failure"),
))


@bringup.check(2, guess="Call change(...) from bring_up, and send the request with call_async in it.")
def requests_transitions(run: Recording) -> None:
    """The node requests transitions from /sensor, /filter and /controller."""
    for node in NODES:
        has_client(run, f"/{node}/change_state", "lifecycle_msgs/srv/ChangeState")
    if not steps(run):
        raise Missed("a call of /sensor/change_state", "no call")
    unknown = next((step for step in steps(run) if step.label not in (*UP, *DOWN)), None)
    if unknown is not None:
        hint = "request = ChangeState.Request(), and then request.transition.label = label."
        raise Missed(f"one of the transitions {', '.join((*UP, *DOWN))}", unknown.text, hint)


@bringup.check(4, after=requests_transitions, only=("recovers", "broken"))
def configures_in_order(run: Recording) -> None:
    """Each node is configured only when the one before it is inactive."""
    for step in steps(run, "configure"):
        _is_not_early(run, step, NODES[: NODES.index(step.node)], INACTIVE)
    for before, node in itertools.pairwise(("", *NODES)):
        if before and (steps(run, "activate") or not _succeeded(run, before, "configure")):
            return  # what is missing is another check's
        _is_requested(run, node, "configure", f"when /{before} is inactive" if before else "first")


@bringup.check(3, after=configures_in_order, only="recovers")
def tries_again(run: Recording) -> None:
    """If a node can't be configured, the same is requested again, until it succeeds."""
    for node in NODES:
        tried = [step for step in steps(run, "configure") if step.node == node]
        for before, again in itertools.pairwise(tried):
            if again.requested < before.answered - EDGE:
                raise Missed(f"one request at a time to /{node}", f"{again.text}, before the response to the "
                             f"one at {before.requested:.3g} s", EARLY)  # fmt: skip
        if not any(step.success for step in tried):
            guess = AGAIN.format(bringup.drawn.word)
            expected = f"configure of /{node} requested again after {len(tried)} failed"
            saw = f"no request after the one at {tried[-1].requested:.3g} s" if tried else "no request"
            raise Missed(expected, saw, guess=guess)


@bringup.check(4, after=tries_again, only="recovers")
def activates_in_order(run: Recording) -> Seconds:
    """When all three are inactive, they are activated in order, and stay active until the shutdown."""
    end = course_calls(run, SHUTDOWN)[0].requested or 0.0
    for step in steps(run, "activate"):
        _is_not_early(run, step, NODES, INACTIVE)
        _is_not_early(run, step, NODES[: NODES.index(step.node)], ACTIVE)
    for node in NODES:
        _is_requested(run, node, "activate", "when all three are inactive")
        now = state(run, node, end)
        if now != ACTIVE:
            guess = ("Shut down only in on_shutdown, and when a transition has failed "
                     f"{bringup.drawn.word} times.")
            expected = f"/{node} active until {SHUTDOWN} is called at {end:.3g} s"
            raise Missed(expected, STATES[now], guess=guess)
    return end


@bringup.check(3, after=activates_in_order, only="recovers")
def shuts_down_in_reverse(run: Recording, end: Seconds) -> None:
    """When /bringup/shutdown (Trigger) is called, the three are shut down in reverse order."""
    offers(run, SHUTDOWN, "std_srvs/srv/Trigger")
    require_reverse(run, end)
    call = course_calls(run, SHUTDOWN)[0]
    if not is_success(call):
        guess = "response.success = True, and return response."
        raise wrong_response(f"success=True for {call_text(call)}", call, guess, credit=0.5)


@bringup.check(1, after=requests_transitions, only="interrupted")
def ends_during_the_bringup(run: Recording) -> None:
    """If /bringup/shutdown is called during the bringup, the three are shut down in the same way."""
    offers(run, SHUTDOWN, "std_srvs/srv/Trigger")
    try:
        require_reverse(run, course_calls(run, SHUTDOWN)[0].requested or 0.0)
    except Missed as missed:
        missed.hint = INTERRUPTED
        raise


@bringup.check(3, after=configures_in_order, only="broken")
def gives_up(run: Recording) -> Seconds:
    """After a transition has failed three times, an error is logged, and nothing else is started."""
    failed = next((step for step in steps(run, *UP) if not step.success), None)
    if failed is None:
        raise Missed("a request for each configure, then for each activate", _last(run), ORDER)
    tried = [step for step in steps(run, failed.label) if step.node == failed.node]
    count = bringup.drawn
    if len(tried) != count.tries:
        expected = f"{count.tries} requests for {failed.label} of /{failed.node}, all of which fail"
        saw = f"{len(tried)} request{'s' * (len(tried) > 1)}"
        guess = END if len(tried) > count.tries else AGAIN
        raise Missed(expected, saw, guess=guess.format(count.word))
    last = tried[-1]
    for step in steps(run, *UP):
        if step.requested >= last.answered - EDGE:
            drives = step.success and (step.node, step.label) == (NODES[-1], "activate")
            expected = (f"nothing configured or activated after the {count.last} failure at "
                        f"{last.answered:.3g} s")
            raise Missed(expected, step.text, END.format(count.word), unsafe=drives)
    with hinting('Before you shut down: self.get_logger().error(f"/{name} can\'t be brought up").'):
        logs(run, rf"\b{failed.node}\b", level="ERROR", example=f"/{failed.node} can't be brought up")
    return last.answered


@bringup.check(2, after=gives_up, only="broken")
def leaves_nothing_running(run: Recording, end: Seconds) -> None:
    """After that, all three are shut down in reverse order."""
    require_reverse(run, end)


def _succeeded(run: Recording, node: str, label: str) -> bool:
    return any(step.success for step in steps(run, label) if step.node == node)


def _is_requested(run: Recording, node: str, label: str, when: str) -> None:
    if not any(step.node == node for step in steps(run, label)):
        raise Missed(f"{label} requested from /{node}, {when}", f"no such request; {_last(run)}", guess=ORDER)


def _last(run: Recording) -> str:
    made = [step for step in steps(run) if step.label not in DOWN]
    return f"the last one was {made[-1].text}" if made else "none at all"


def _is_not_early(run: Recording, step: Step, others: tuple[str, ...], least: int) -> None:
    """Raise Missed where one of these nodes hasn't reached a state when a transition is requested."""
    for other in others:
        now = state(run, other, step.requested)
        if now < least:
            label = "activate" if least == ACTIVE else "configure"
            tried = [it for it in steps(run, label) if it.node == other and it.requested <= step.requested]
            hint = FAILED if any(it.answered <= step.requested for it in tried) else EARLY if tried else ORDER
            expected = f"/{other} {STATES[least]} before {step.label} is requested from /{step.node}"
            unsafe = step.success and (step.node, step.label) == (NODES[-1], "activate")
            raise Missed(expected, f"{step.text}, while /{other} was {STATES[now]}", hint, unsafe=unsafe)

"""A node that uses messages of one's own: it stores crates, and finds those that are light enough."""

from collections.abc import Callable
from functools import partial
from typing import Any

from grader.checks import Missed, hinting, offers, publishes
from grader.checks.packages import names_what_it_imports
from grader.checks.services import call_text, sent_at
from grader.exercise import Exercise, Scenario
from grader.exercises.launching.keeper.crates import FIND, FULL, INTERFACES, SCANNED, crates
from grader.responses import Stimuli, requests_from_course
from grader.variants import Variants
from grader.workspace.installation import ros2_run
from grader.workspace.package import PackageRun
from sim.evidence import Call, Recording

SOON = 0.2  # s
NEWEST = ("A crate that is scanned again has new values: replace the old ones with self.crates[msg.label] = "
          "msg.")
FORWARD = "In the callback of /crates: self.full.publish(msg) if msg.state is Crate.FULL."
LIMIT = "A crate of exactly this mass counts, too: crate.mass <= request.heaviest."

keeper = Exercise("keeper", "A node that uses your messages", package="crate_keeper", uses=INTERFACES,
                  scenarios=[
    Scenario(seconds=8.5, seed=seed, prepare=partial(ros2_run, "crate_keeper", "keeper"), companions=crates)
    for seed in (1, 2)
], variants=Variants({"full": ("/full", "/loaded", "/heavy"), "name": ("full", "loaded", "heavy")},
                     texts=("{full}", '"{name}"')))


@keeper.check(2)
def publishes_crates(run: PackageRun) -> None:
    """`ros2 run crate_keeper keeper` publishes messages of your type Crate on /full."""
    full = keeper.drawn.full
    with hinting(f"Write from crate_interfaces.msg import Crate, and create a publisher for {full}."):
        publishes(run, full, "crate_interfaces/msg/Crate")


@keeper.check(4, after=publishes_crates)
def forwards_full_crates(run: PackageRun) -> None:
    """Each crate on /crates that is FULL is published on /full unchanged, and no other."""
    full = keeper.drawn.full
    for crate in Stimuli(SCANNED, answered_on=full, within=SOON, what="crates on /crates")(run):
        what = f"{crate.value.label} ({crate.value.mass:g} kg)"
        if crate.value.state != FULL:
            hint = "if msg.state == Crate.FULL: publish it. The constant is in your message."
            crate.expects_nothing(f"nothing for {what}, which is EMPTY", hint, field="label")
        elif crate.value not in [response.message for response in crate.responses]:
            saw = crate.seen("label")
            same = [response for response in crate.responses if response.message.label == crate.value.label]
            hint = "Publish the message that you received, with all of its fields." if same else FORWARD
            expected = f"{what} on {full} within {SOON:g} s of {crate.stamp:.3g} s"
            raise Missed(expected, f"{saw}, with other fields" if same else saw, hint)


@keeper.check(2)
def offers_to_find(run: PackageRun) -> None:
    """It offers the service /find_crates, of your type FindCrates."""
    offers(run, FIND, "crate_interfaces/srv/FindCrates")


@keeper.check(5, after=offers_to_find, hints={
    "The response is empty: put each crate that is light enough into response.crates.":
        lambda run, call: _found(call) == [],
    NEWEST: lambda run, call: _finds_old_values(run, call),
    LIMIT: lambda run, call: _left_out(run, call, lambda crate: crate.mass == call.request.heaviest),
    "EMPTY crates belong in the response, too: only /full is limited to the FULL ones.":
        lambda run, call: _left_out(run, call, lambda crate: crate.state != FULL),
    "heaviest is a limit: leave out what is heavier.":
        lambda run, call: any(crate.mass > call.request.heaviest for crate in _crates(call)),
})
def finds_crates(run: PackageRun) -> None:
    """Each response has the crates that are not heavier, with their most recently scanned values."""
    for call in requests_from_course(run, FIND, at_least=2):
        wanted = sorted(crate.label for crate in _right(run, call))
        found = _found(call)
        if found is None or sorted(_crates(call), key=_label) != _right(run, call):
            saw = "no response" if found is None else ", ".join(found) or "no crate"
            saw += ", with other values" if found is not None and sorted(found) == wanted else ""
            raise Missed(f"{', '.join(wanted) or 'no crate'} for {call_text(call)}", saw, about=(call,))


@keeper.check(1)
def names_the_types(run: PackageRun) -> None:
    """package.xml names every package that the program imports, including crate_interfaces."""
    names_what_it_imports(run)


def _label(crate: Any) -> str:
    return str(crate.label)


def _crates(call: Call) -> list[Any]:
    return [] if call.response is None else list(call.response.crates)


def _found(call: Call) -> list[str] | None:
    """The labels in a response; None without one."""
    return None if call.response is None else [crate.label for crate in _crates(call)]


def _scanned_before(run: Recording, call: Call) -> list[Any]:
    return [row.message for row in run.received(SCANNED) if row.stamp < sent_at(call)]


def _light_enough(crates: dict[str, Any], call: Call) -> list[Any]:
    return sorted((crate for crate in crates.values() if crate.mass <= call.request.heaviest), key=_label)


def _right(run: Recording, call: Call) -> list[Any]:
    """The crates of the right response, by their labels."""
    return _light_enough({crate.label: crate for crate in _scanned_before(run, call)}, call)


def _finds_old_values(run: Recording, call: Call) -> bool:
    """Return whether the response has a crate with replaced values, or is right for the first values."""
    scanned_before = _scanned_before(run, call)
    first = {crate.label: crate for crate in reversed(scanned_before)}
    newest = {crate.label: crate for crate in scanned_before}
    replaced = [crate for crate in _crates(call) if crate in scanned_before and crate != newest[crate.label]]
    return bool(replaced) or sorted(_crates(call), key=_label) == _light_enough(first, call)


def _left_out(run: Recording, call: Call, kind: Callable[[Any], bool]) -> bool:
    """Return whether crates are missing in the response, and all of them are of this kind."""
    missing = [crate for crate in _right(run, call) if crate.label not in (_found(call) or [])]
    return bool(missing) and all(map(kind, missing))

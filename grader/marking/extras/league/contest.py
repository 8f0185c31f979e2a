"""A contest and its results as data that crosses processes: the warehouses, and what a robot did in one."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from grader.checks.shift import Shift, shift
from grader.diagnosis import find_fault, find_flaw
from grader.exercise import Scenario
from grader.namespaced_programs import in_namespaces
from grader.seeds import private_seed
from sim import World
from sim.evidence import Recording, Seconds


@dataclass(frozen=True)
class Contest:
    """The warehouses in which all robots of a league work.

    seed: text from which all warehouses are drawn; "" for the public ones, of the seeds 0, 1, 2 and so on.
    worlds: how many. seconds: of simulated time in each. robots: in each, all with the same programs.
    """

    seed: str = ""
    worlds: int = 10
    seconds: Seconds = 120.0
    robots: int = 1

    def rounds(self) -> Iterator[tuple[Scenario, int]]:
        """Each warehouse's scenario, with its seed."""
        names = ["robot", *(f"robot_{number}" for number in range(2, self.robots + 1))]
        scenario = Scenario(
            lambda seed: World.generate("warehouse", seed=seed, robots=self.robots),
            self.seconds,
            prepare=functools.partial(in_namespaces, *names) if self.robots > 1 else None,
        )
        for index in range(self.worlds):
            yield scenario, private_seed(self.seed, "league", index) if self.seed else index


@dataclass(frozen=True)
class Game:
    """One capstone's results in one warehouse.

    delivered: orders that count: those delivered before a person was touched. orders: all orders. people,
    contacts: how often it touched a person, and anything else. waited: the time of all orders that count (s).
    way: its path (m). digest: of the recording. replay: from `pack_motion`; "" without any motion. why: the
    error of its programs, which may quote their text; or "".
    """

    delivered: int
    orders: int
    people: int
    contacts: int
    waited: Seconds
    way: float
    digest: str
    replay: str
    why: str

    def as_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        return asdict(self)


def game_of(recording: Recording) -> Game:
    """The result of a run in a warehouse. Raises ValueError for another run."""
    from sim.view.ghost_replay import pack_motion

    done = shift(recording)
    took = counted(done)
    people = done.touched.get("person", 0)
    return Game(
        delivered=len(took),
        orders=len(done.jobs),
        people=people,
        contacts=sum(done.touched.values()) - people,
        waited=round(sum(took), 3),
        way=round(done.way, 3),
        digest=recording.digest,
        replay=pack_motion(recording) if recording.path else "",
        why=_why(recording, bool(took)),
    )


def counted(done: Shift) -> list[Seconds]:
    """The time of each order that counts: none after a person was touched."""
    return [
        job.over - job.requested
        for job in done.delivered
        if job.over is not None and (done.met_person is None or job.over < done.met_person)
    ]


def _why(recording: Recording, delivers: bool) -> str:
    fault = find_fault(recording)
    if fault is not None:
        return f"{fault.saw}. {fault.hint}".rstrip()
    return "" if delivers else find_flaw(recording) or ""

"""One run of the student's programs, with the world and the companions that it has."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from grader.orders import USUAL, without_late_start
from grader.programs import Prepare, ProgramSource
from grader.workspace.package import Package, PackageRun
from sim.evidence import Recording, Seconds
from sim.network import Network

Companions = Sequence[Any] | Callable[[int], Sequence[Any]]


class CompanionError(Exception):
    """A node of the course raised an exception: not the student's mistake."""


@dataclass(frozen=True)
class Scenario:
    """One run of the student's nodes.

    seconds: how long it lasts; 0 where nothing is run, and only the package is looked at.
    world: the name of a world, or None for a run without a robot; or a function of the seed that gives a
        World, such as `lambda seed: World.generate("maze", seed=seed)`.
    companions: programs of the course, as for sim.run; or a function of the seed that returns them.
    until: a function of the growing recording that ends the run early, as in sim.run.
    prepare: a module's function that makes of each of the student's programs the one that runs in its place.
    prepare_for: in place of it, a function of the seed that returns it.
    name: by which checks that hold in some scenarios only name this one.
    network: what lies between the robot and the student's nodes, as in sim.run.
    fair: the seeds of which students get one each when they are marked, where luck decides in others.
    waits: the world waits for the student's nodes, so that in another order they may start later.
    any_order: it is fair in any order; otherwise it happens in the usual one only.
    """

    world: Any = None
    seconds: Seconds = 10.0
    seed: int = 0
    companions: Companions = ()
    until: Callable[[Recording], bool] | None = None
    prepare: Prepare | None = None
    name: str = ""
    network: Network | None = None
    fair: Sequence[int] = ()
    waits: bool = True
    any_order: bool = True
    prepare_for: Callable[[int], Prepare] | None = None

    def run(
        self, source: ProgramSource, seed: int, package: Package | None = None, order: str = ""
    ) -> Recording:
        """Run the student's nodes, or programs of the package: then the recording is a `PackageRun`.

        order: as in sim.run; "" for the usual one. The course's programs start first, as a robot's drivers
        do. Raises CompanionError if one raised.
        """
        recording = self._run(source, seed, order) if self.seconds else Recording(seed=seed)
        return recording if package is None else PackageRun.of(recording, package)

    def _run(self, source: ProgramSource, seed: int, order: str) -> Recording:
        from sim import run

        prepare = self.prepare or (self.prepare_for and self.prepare_for(seed))
        recording = run(
            *source.programs(prepare),
            companions=self.companions(seed) if callable(self.companions) else self.companions,
            world=self._world(seed),
            seconds=self.seconds,
            seed=seed,
            until=self.until,
            quiet=True,
            network=self.network,
            expect_error=True,  # the score reports it
            order=self._possible(order),
        )
        for error in recording.course_errors:
            raise CompanionError(f"{error.node}: {error.type}{error.says}\n{error.traceback}")
        return recording

    def _possible(self, order: str) -> str:
        order = order if self.any_order else USUAL
        return order if self.waits else without_late_start(order)

    def _world(self, seed: int) -> Any:
        if not callable(self.world):
            return self.world
        world = self.world(seed)
        # Scores and replays show the name, and in marking the seed is a private one.
        return replace(world, name=world.name.removesuffix(f"_{seed}"))

"""What a depot is connected to: a person who sends jobs, and a scale."""

import random
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32

UP, DOWN, SWEEP, LOAD = JOBS = "up", "down", "sweep", "load"
FIRST, SECOND = 0.1, 1.0  # s: when up or down is sent, and when sweep or load
APART, NEAR = 0.3, 0.05  # s: how much later the other one is sent, at most
WEIGHING = 0.15  # s
WEIGHTS = 1, 50  # kg


class DepotJob(NamedTuple):
    """A job: when it is sent (s), its name, and its number."""

    stamp: float
    name: str
    number: int


def draw_jobs(seed: int) -> list[DepotJob]:
    """Return the jobs of a run with this seed."""
    drawn = random.Random(f"depot {seed}")
    jobs = []
    for begin, most, pair in ((FIRST, APART, [UP, DOWN]), (SECOND, NEAR, [SWEEP, LOAD])):
        drawn.shuffle(pair)
        later = most * drawn.random() ** 2  # mostly so little that the two meet
        for name, stamp in zip(pair, (begin, round(begin + later, 2)), strict=True):
            jobs.append(DepotJob(stamp, name, drawn.randint(100, 999)))
    return jobs


class JobSender(Node):
    """Sends each job as its number: Int32 on /up, /down, /sweep or /load.

    A timer goes on, so that the run of a program that hangs goes on to its end.
    """

    def __init__(self, seed: int = 0) -> None:
        super().__init__("job_sender")
        self.senders = {name: self.create_publisher(Int32, f"/{name}", 10) for name in JOBS}
        self.create_timer(0.1, lambda: None)
        for job in draw_jobs(seed):
            self.send_later(job)

    def send_later(self, job: DepotJob) -> None:
        """Send a job once, when its time has come."""

        def once() -> None:
            timer.cancel()
            self.senders[job.name].publish(Int32(data=job.number))

        timer = self.create_timer(job.stamp, once)


class ParcelScale(Node):
    """Weighs the parcel with number `a` (AddTwoInts on /scale): `sum` is its weight, 0.15 s later."""

    def __init__(self, seed: int = 0) -> None:
        group = ReentrantCallbackGroup()
        super().__init__("parcel_scale")
        self.drawn = random.Random(f"scale {seed}")
        self.create_service(AddTwoInts, "/scale", self.weigh, callback_group=group)
        self.pending: list[Future] = []
        self.timer = self.create_timer(WEIGHING, self.settle, callback_group=group)
        self.timer.cancel()

    async def weigh(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        """Respond with a weight (kg)."""
        settled = Future()
        self.pending.append(settled)
        self.timer.reset()
        await settled
        response.sum = self.drawn.randint(*WEIGHTS)
        return response

    def settle(self) -> None:
        """End the weighing under way."""
        self.timer.cancel()
        while self.pending:
            self.pending.pop().set_result(None)


def job_site(seed: int) -> list[Callable[[], Node]]:
    """Return the person and the scale, as companions of a run."""
    return [partial(JobSender, seed), partial(ParcelScale, seed)]

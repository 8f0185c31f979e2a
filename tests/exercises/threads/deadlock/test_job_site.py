"""The jobs of a depot, its scale, and the program that hangs with them."""

import linecache

import pytest
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node

from grader.exercises.threads.deadlock import DEPOT, job_site
from grader.exercises.threads.deadlock.job_site import APART, FIRST, JOBS, NEAR, SECOND, WEIGHING, draw_jobs
from sim import run


@pytest.mark.parametrize("seed", range(20))
def test_each_job_is_sent_once_and_the_pairs_are_near_each_other(seed):
    jobs = draw_jobs(seed)
    assert sorted(job.name for job in jobs) == sorted(JOBS)
    stamps = [job.stamp for job in jobs]
    assert stamps[0] == FIRST and FIRST <= stamps[1] <= FIRST + APART
    assert stamps[2] == SECOND and SECOND <= stamps[3] <= SECOND + NEAR


def test_either_job_of_a_pair_may_come_first():
    assert {draw_jobs(seed)[0].name for seed in range(1, 9)} == {"up", "down"}
    assert {draw_jobs(seed)[2].name for seed in range(1, 9)} == {"sweep", "load"}


class Weigher(Node):
    """Weighs a parcel again and again."""

    def __init__(self):
        super().__init__("weigher")
        self.client = self.create_client(AddTwoInts, "/scale")
        self.create_timer(0.4, self.weigh)

    def weigh(self):
        self.client.call_async(AddTwoInts.Request(a=7))


def test_the_scale_takes_its_time():
    calls = run(Weigher, companions=job_site(1), seconds=1.5, quiet=True).calls_of("/scale")
    assert len(calls) > 2
    for call in calls[:3]:
        assert call.answered - call.requested == pytest.approx(WEIGHING, abs=0.02)
        assert 1 <= call.response.sum <= 50


def test_the_given_program_hangs_in_the_lines_of_its_dump():
    name = "depot.py"
    linecache.cache[name] = (len(DEPOT), None, DEPOT.splitlines(keepends=True), name)
    names = {"__name__": "depot"}
    exec(compile(DEPOT, name, "exec"), names)
    recording = run(names["main"], companions=job_site(6), seconds=2.5, quiet=True, expect_error=True)
    assert recording.ended.reason == "blocked"
    assert "with self.lift:" in recording.ended.detail or "with self.corridor:" in recording.ended.detail

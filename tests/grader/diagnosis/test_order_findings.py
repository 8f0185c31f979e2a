"""Nodes that work only in the order of this run: the sentence for each, and none for their right twins."""

import copy

import pytest

from grader.diagnosis import find_fault, find_flaw
from grader.diagnosis.order_findings import FINDINGS
from sim import run
from tests.students import orders

LOCK = "Change self.{} only inside `with self.lock:`, with one threading.Lock() for the node."
HANGS = (
    "When both run at the same time, each can wait for the lock that the other holds, and the node hangs for good, "
    "even if it did not in this run. Take the two in the same order everywhere."
)
# Students' programs, and the sentence.
SENTENCES = {
    (
        orders.Pairs,
        orders.TwoTopics,
    ): "Pairs.on_b uses self.last, which only Pairs.on_a sets and which starts as None. "
    "Nothing determines which of the two runs first; in this run Pairs.on_a did, at 0.1 s, and Pairs.on_b at 0.1 s. Begin "
    "Pairs.on_b with `if self.last is None: return`.",
    (
        orders.PairsWithoutInit,
        orders.TwoTopics,
    ): "PairsWithoutInit.on_b uses self.offset, which only PairsWithoutInit.on_a sets and which does not exist before "
    "that. Nothing determines which of the two runs first; in this run PairsWithoutInit.on_a did, at 0.1 s, and "
    "PairsWithoutInit.on_b at 0.1 s. Set self.offset = None in __init__, and begin PairsWithoutInit.on_b with `if "
    "self.offset is None: return`.",
    (
        orders.TwoTimers,
    ): "TwoTimers.step sets self.steps, and TwoTimers.send uses it. Both are timers of /two_timers with a period of "
    "0.1 s. The current rclpy first runs the one that was created first, but nothing guarantees that: TwoTimers.send gets the "
    "value of this period or of the one before. Do both in one callback, in the order that they need.",
    (
        orders.Stock,
        orders.Shop,
    ): "Stock.buy tests self.left, awaits, and then uses self.left; during the await, at 0.6 s, another execution of "
    "Stock.buy changed it. The result of the test may no longer hold. Test self.left again after the await, or change it "
    "before the await.",
    (
        orders.count_with_threads,
        orders.TwoTopics,
    ): "Counter.on_a reads self.count and writes it back, and may run at the same time as Counter.on_b, which also changes it: the executor has several threads, and the two have different callback groups. A change that the other "
    f"makes in between is lost. {LOCK.format('count')}",
    (
        orders.count_reentrantly,
        orders.TwoTopics,
    ): "CountsReentrantly.on_a reads self.count and writes it back, and may run at the same time as itself, which also changes it: the executor has several threads, and the callback group is reentrant. A change that the other "
    f"makes in between is lost. {LOCK.format('count')}",
    (
        orders.Works,
        orders.TwoTopics,
    ): "Works.on_a reads self.sum and writes it back, and may run at the same time as Works.work, which also changes it: Works.work runs in a thread of its own. A change that the other makes in between is lost. "
    f"{LOCK.format('sum')}",
    (
        orders.lock_with_threads,
        orders.TwoTopics,
    ): "BothOrders.on_a takes self.left, then self.right; BothOrders.on_b takes self.right, then self.left. "
    + HANGS,
    (
        orders.acquire_with_threads,
        orders.TwoTopics,
    ): "AcquiresInBothOrders.on_b takes self.right, then self.left; AcquiresInBothOrders.on_a takes self.left, then "
    "self.right. " + HANGS,
    (
        orders.Disparity,
        orders.TwoCameras,
    ): "Disparity.on_right combines its message of /right with self.last, the last one of /left, as if both belonged "
    "to the same instant: it combined /right of 0.3 s with /left of 0.2 s, although there is one of 0.3 s. Pair them "
    "by stamp: subscribe with message_filters.Subscriber, and register the callback with "
    "message_filters.TimeSynchronizer([a, b], 10).",
}
RIGHT = [
    (orders.PairsCarefully, orders.TwoTopics),
    (orders.PairsByName, orders.TwoTopics),
    (orders.PairsFromZero, orders.TwoTopics),
    (orders.OneTimer,),
    (orders.ReservesStock, orders.Shop),
    (orders.TestsStockAgain, orders.Shop),
    (orders.Counter, orders.TwoTopics),  # the executor has one thread
    (orders.count_under_a_lock, orders.TwoTopics),
    (orders.count_in_one_group, orders.TwoTopics),
    (orders.WorksAlone, orders.TwoTopics),
    (orders.BothOrders, orders.TwoTopics),  # the executor has one thread
    (orders.lock_in_one_order, orders.TwoTopics),
    (orders.lock_one_after_the_other, orders.TwoTopics),
    (orders.lock_under_a_third, orders.TwoTopics),
    (orders.ComparesStamps, orders.TwoCameras),
    (orders.Synchronizes, orders.TwoCameras),
]


def record(students):
    return run(*students, seconds=2, quiet=True)


def names(students):
    return students[0].__name__


@pytest.mark.parametrize("students, sentence", SENTENCES.items(), ids=map(names, SENTENCES))
def test_what_is_right_only_by_luck_is_reported(students, sentence):
    recording = record(students)
    assert find_fault(recording) is None
    assert find_flaw(recording) == sentence


@pytest.mark.parametrize("students", RIGHT, ids=names)
def test_a_node_that_is_right_in_every_order_has_no_flaw(students):
    recording = record(students)
    assert find_fault(recording) is None
    assert find_flaw(recording) == ""


def test_every_finding_has_a_node():
    recordings = [record(students) for students in SENTENCES]
    assert [finding.__name__ for finding in FINDINGS if not any(map(finding, recordings))] == []


def test_without_the_programs_of_a_run_nothing_is_reported():
    assert find_flaw(copy.copy(record((orders.Pairs, orders.TwoTopics)))) == ""

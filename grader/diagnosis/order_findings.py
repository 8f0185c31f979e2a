"""Findings about programs that are right only in the order in which this run happened to execute them."""

from grader.diagnosis import await_races, lock_order, thread_races, unfixed_order, unpaired
from sim.evidence import Recording

# The most exact first.
FINDINGS = (
    unfixed_order.set_by_another,
    lock_order.both_orders,
    thread_races.lost_update,
    await_races.used_after_await,
    unpaired.other_instant,
    unfixed_order.equal_timers,
)


def find(recording: Recording) -> str:
    """The first finding, as a sentence; "" if there is none, or if the programs of the run are not known.

    A copy of a recording has no programs: pass the one that `run` returned.
    """
    return next((sentence for finding in FINDINGS if (sentence := finding(recording))), "")

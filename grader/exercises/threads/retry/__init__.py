"""Commands over a bad network: carried out exactly once, and given up after a deadline."""

from typing import NamedTuple

from grader.checks import Missed, publishes
from grader.exercise import Exercise
from grader.exercises.threads.retry.radio_site import APART, NEITHER, ORDERS, draw_conditions, radio_site
from grader.responses import EDGE, from_course, from_student
from sim.evidence import Message, Recording, Seconds

__all__ = ["radio_site", "retry"]

SENT, ARRIVED = "/panel/sent", "/dispenser/received"
ANSWERED, CAME_BACK = "/dispenser/sent", "/panel/received"
SCREWS, REPORTS = "/screws", "/reports"
DONE, UNKNOWN = "done", "unknown"
DEADLINE, EARLY, LATE = 2.0, 0.05, 0.25  # s
QUIET = 0.05  # s after a report, from when on nothing is sent
NEW_ID = ("Each retry carries a new id, so the dispenser can't know that it's the same order. Draw the id "
          "once, in on_order.")  # fmt: skip
REMEMBER = ("Store the ids of all orders that were carried out in a set: a message whose id is in it gets an "
            "answer, but no screws.")  # fmt: skip

retry = Exercise("retry", "Commands over a bad network", seconds=1.0 + APART * ORDERS, companions=radio_site,
                 seeds=(1, 2))  # fmt: skip


class DispenserOrder(NamedTuple):
    """An order of the run, and what happened until the next one.

    lost: what the link didn't carry. begin, end: when it was placed, and when the next one was (s).
    """

    screws: int
    lost: str
    begin: Seconds
    end: Seconds
    sent: list[Message]
    effects: list[Message]
    reports: list[Message]


@retry.check(1)
def uses_the_link(run: Recording) -> None:
    """The panel publishes strings on /panel/sent, and the dispenser on /dispenser/sent."""
    publishes(run, SENT, "std_msgs/msg/String")
    publishes(run, ANSWERED, "std_msgs/msg/String")


@retry.check(2, after=uses_the_link)
def gets_through(run: Recording) -> None:
    """Each order whose messages the link carries gets its screws."""
    for order in _carried(run):
        amounts = [row.message.data for row in order.effects]
        if order.screws not in amounts:
            expected = f"{order.screws} on {SCREWS} for the order at {order.begin:.3g} s"
            raise Missed(expected, _amounts(order), _why_nothing(run, order))


@retry.check(4, after=gets_through, guess=REMEMBER)
def takes_effect_once(run: Recording) -> None:
    """No order gets its screws a second time, and none gets screws if no message of the panel arrived."""
    for order in _orders(run):
        most = 0 if order.lost == NEITHER else 1
        if len(order.effects) > most:
            where = f"for the order at {order.begin:.3g} s"
            expected = f"{'one message' if most else 'nothing'} on {SCREWS} {where}"
            raise Missed(expected, _amounts(order), _why_again(run, order), picture="topics")


@retry.check(3, after=gets_through)
def reports_what_was_done(run: Recording) -> None:
    """If an answer comes back, the panel reports `done` once, after the screws, and stops sending."""
    for order in _carried(run):
        if order.lost:
            continue
        where, reports = f"for the order at {order.begin:.3g} s", [row.message.data for row in order.reports]
        if reports != [DONE]:
            saw = ", ".join(f"“{text}”" for text in reports[:4]) or "nothing"
            raise Missed(f"one report, “{DONE}”, {where}", saw, _why_not_done(run, order))
        reported = order.reports[0].stamp
        if not any(row.stamp <= reported for row in order.effects):
            saw = f"“{DONE}” at {reported:.4g} s, before"
            raise Missed(f"“{DONE}” {where} after its screws", saw, _why_too_early(run, order))
        _sends_nothing_after(order, reported, "An order that was answered is sent no more.")


@retry.check(4, after=gets_through)
def gives_up(run: Recording) -> None:
    """If no answer comes back, the panel reports `unknown` once, 2 s after the order, and stops sending."""
    for order in _orders(run):
        if not order.lost:
            continue
        where, reports = f"for the order at {order.begin:.3g} s", [row.message.data for row in order.reports]
        if reports != [UNKNOWN]:
            saw = ", ".join(f"“{text}”" for text in reports[:4]) or "nothing"
            raise Missed(f"one report, “{UNKNOWN}”, {where}", saw, _why_not_unknown(reports))
        took = order.reports[0].stamp - order.begin
        if not DEADLINE - EARLY <= took <= DEADLINE + LATE:
            hint = "Store when the order came, and compare the time since then with 2.0 s in the timer."
            raise Missed(f"“{UNKNOWN}” {where} after {DEADLINE:g} s", f"after {took:.3g} s", hint)
        _sends_nothing_after(order, order.reports[0].stamp, "An order that was given up is sent no more.")


def _orders(run: Recording) -> list[DispenserOrder]:
    """All orders of the run that had their time, in their order."""
    placed = from_course(run, "/orders", at_least=ORDERS)
    begins = [row.stamp for row in run.messages("/orders") if row.from_course]
    ends = [*begins[1:], run.ended.stamp]
    orders = []
    for row, lost, begin, end in zip(placed, draw_conditions(run.seed), begins, ends, strict=True):
        within = [_between(from_student(run, topic), begin, end) for topic in (SENT, SCREWS, REPORTS)]
        orders.append(DispenserOrder(row.message.data, lost, begin, end, *within))
    return orders


def _carried(run: Recording) -> list[DispenserOrder]:
    """The orders whose messages reach the dispenser."""
    return [order for order in _orders(run) if order.lost != NEITHER]


def _between(rows: list[Message], begin: Seconds, end: Seconds) -> list[Message]:
    return [row for row in rows if begin <= row.stamp < end]


def _sends_nothing_after(order: DispenserOrder, reported: Seconds, hint: str) -> None:
    later = [row for row in order.sent if row.stamp > reported + QUIET]
    if later:
        expected = f"nothing on {SENT} from the report at {reported:.4g} s until the next order"
        raise Missed(expected, f"{len(later)} messages, the first at {later[0].stamp:.4g} s", hint)


def _amounts(order: DispenserOrder) -> str:
    shown = [f"{row.message.data} at {row.stamp:.4g} s" for row in order.effects[:4]]
    return ", ".join(shown) or "nothing until the next order"


def _why_nothing(run: Recording, order: DispenserOrder) -> str:
    """Return why an order may have had no effect."""
    if not order.sent:
        return f"The panel sent nothing on {SENT} after this order."
    if _arrived(run, order, order.end):
        if not from_student(run, SCREWS):
            return f"The panel's message arrived. The dispenser publishes the number of screws on {SCREWS}."
        return ("The panel's message arrived. An order for as many screws as an earlier one is another one: "
                "compare ids, and nothing else.")  # fmt: skip
    if DONE in [row.message.data for row in order.reports]:
        return _why_too_early(run, order)
    return "The panel's messages for this order were lost. Send it again every 0.1 s until it's answered."


def _why_again(run: Recording, order: DispenserOrder) -> str:
    before = _between(run.messages(ARRIVED), order.begin, order.effects[0].stamp + EDGE)
    if order.lost == NEITHER and not before:
        return "No message reached the dispenser, so it can't know this order. Use only the link."
    texts = {row.message.data for row in order.sent}
    return NEW_ID if len(order.sent) > 1 and len(texts) == len(order.sent) else ""


def _why_not_done(run: Recording, order: DispenserOrder) -> str:
    arrived = _between(run.messages(ARRIVED), order.begin, order.end)
    if len(_between(from_student(run, ANSWERED), order.begin, order.end)) < len(arrived):
        return "Answer each message that arrives, also a known one: the first answer may have been lost."
    return "Report when the answer with this order's id arrives, and then forget the order."


def _why_too_early(run: Recording, order: DispenserOrder) -> str:
    reported = order.reports[0].stamp
    if not _between(run.messages(CAME_BACK), order.begin, reported + EDGE):
        return "Until an answer has come back, the panel doesn't know what was done. Report when it comes."
    if _arrived(run, order, reported):
        return "The dispenser has to give out the screws before it answers."
    return "An answer to an earlier order may arrive late: compare the id in it with this order's id."


def _arrived(run: Recording, order: DispenserOrder, end: Seconds) -> bool:
    """Return whether a message that the panel sent for this order reached the dispenser before a time."""
    texts = {row.message.data for row in order.sent}
    return any(row.message.data in texts for row in _between(run.messages(ARRIVED), order.begin, end))


def _why_not_unknown(reports: list[str]) -> str:
    if DONE in reports:
        return ("No answer to this order came back, so the panel can't know. An answer to an earlier order "
                "may arrive late: compare ids.")  # fmt: skip
    if UNKNOWN in reports:
        return "Report once, and then forget the order."
    return f"Without an answer, the panel has to give up after 2 s, and report “{UNKNOWN}”: it doesn't know."

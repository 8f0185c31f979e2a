"""Advice on message_filters: inputs and callbacks that do not have the form that a filter needs."""

from __future__ import annotations

import re

from sim.evidence import CallbackError, last_line

INPUT = (
    "message_filters.Subscriber takes the node first, and then what create_subscription takes: "
    "`Subscriber(self, LaserScan, '/scan')`."
)


def filter_input(error: CallbackError) -> str:
    """A Subscriber that was made without the node, or with its arguments in another order."""
    wrong = re.search(r"tuple index out of range|no attribute 'create_subscription'", error.text)
    return INPUT if wrong and re.search(r"\bSubscriber\(", last_line(error)) else ""


def filter_callback(error: CallbackError) -> str:
    """A callback of a filter that takes another number of messages than it is called with."""
    found = re.search(r"([\w<>]+)\(\) (?:takes|missing) .*?(?:but (\d+) were given|$)", error.text)
    if error.type != "TypeError" or not error.callback.startswith("Subscriber.") or not found:
        return ""
    name, given = found[1], int(found[2] or 0)
    count = given - 1 if given and "lambda" not in name else given
    how_many = "" if not count else f", here {count}" if count > 1 else ", here one"
    called = "The lambda" if "lambda" in name else f"`{name}`"
    return (
        f"{called} is called with one message for each input of its filter{how_many}, in the order of the "
        "inputs: `def on_pair(self, scan, image):` for two."
    )

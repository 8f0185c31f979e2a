"""Exceptions of tf2, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

_CATCH = "Catch tf2_ros.TransformException around the lookup: at the start some transforms are missing."

TRANSFORM_RULES = (
    Rule(
        "ExtrapolationException", r"into the future\. .* time (\S+) but the latest data is at time (\S+),",
        "The transform for time {0} has not arrived yet: the newest is for time {1}. A transform often "
        "arrives later than the measurement with its stamp. Use the newest one, with `rclpy.time.Time()` in "
        "place of the stamp, or wait for it: `timeout=Duration(seconds=0.2)`, in a node that a "
        f"`MultiThreadedExecutor` spins, so that it keeps receiving meanwhile. {_CATCH}",
    ),
    Rule(
        "ExtrapolationException", r"into the past\. .* time (\S+) but the earliest data is at time (\S+),",
        "The buffer has no transform for time {0}: its earliest is for time {1}. It holds the last 10 s, "
        f"and nothing from before the listener started. {_CATCH}",
    ),
    Rule(
        "ExtrapolationException", r"at time (\S+), but only time (\S+) is in the buffer",
        "The buffer has one transform, for time {1}, and none for time {0}: the others have not arrived yet. "
        f"Use `rclpy.time.Time()` for the newest. {_CATCH}",
    ),
    Rule(
        "LookupException", r"\"(.*)\" passed to lookupTransform argument (\w+) does not exist",
        "No transform with the frame `{0}` has arrived: either no node publishes it, the name ({1}) has a "
        f"typo, or the lookup comes too early. {_CATCH}",
    ),
    Rule(
        "ConnectivityException", r"connection between '(.*)' and '(.*)' because",
        "`{0}` and `{1}` are in two trees: no transform that connects them has arrived. Either no node "
        f"publishes it, or the lookup comes too early. {_CATCH}",
    ),
)  # fmt: skip

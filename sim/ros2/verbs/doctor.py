"""ros2 doctor: what is probably wrong with the connections of a system."""

from __future__ import annotations

import os
import platform
from argparse import Namespace
from collections.abc import Iterator
from itertools import product

from rclpy.utilities import get_rmw_implementation_identifier

from sim.evidence import Endpoint
from sim.evidence.qos import offer, refusal
from sim.ros2.group import Group, flag
from sim.ros2.system import System, is_hidden

doctor = Group("doctor", "Check ROS setup and other potential issues")
LEFT_OUT = ("/parameter_events", "/rosout")


@doctor.verb(
    "",
    flag("-r", "--report", help="Print all reports."),
    flag("-rf", "--report-failed", help="Print reports of failed checks only."),
    flag("-iw", "--include-warnings", help="Include warnings as failed checks."),
)
def check(system: System, asked: Namespace) -> None:
    """Check ROS setup and other potential issues."""
    ends = [end for end in system.ends if not is_hidden(end.name)]
    reports = {"platform": _platform, "middleware": _middleware, "topic": _topics}
    if asked.report:
        for report in reports.values():
            report(system, ends)
        return
    warnings, errors = list(_lonely(ends)), list(_misfits(ends))
    for line in (*warnings, *errors):
        system.say(f"UserWarning: {line}")
    failed = ["middleware"] if errors else []
    failed += ["topic"] if warnings and asked.include_warnings else []
    if not failed:
        system.say(f"\nAll {len(reports)} checks passed\n")
        return
    system.say(f"\n{len(failed)}/{len(reports)} check(s) failed\n\nFailed modules: {' '.join(failed)}")
    for name in failed if asked.report_failed else ():
        reports[name](system, ends)


def _of(ends: list[Endpoint], kind: str, topic: str) -> list[Endpoint]:
    return [end for end in ends if end.kind == kind and end.name == topic]


def _names(ends: list[Endpoint]) -> list[str]:
    return sorted({e.name for e in ends if e.kind in ("publisher", "subscription")} - set(LEFT_OUT))


def _pairs(ends: list[Endpoint], topic: str) -> Iterator[tuple[Endpoint, Endpoint]]:
    return product(_of(ends, "publisher", topic), _of(ends, "subscription", topic))


def _lonely(ends: list[Endpoint]) -> Iterator[str]:
    for topic in _names(ends):
        if not _of(ends, "subscription", topic):
            yield f"Publisher without subscriber detected on {topic}."
        elif not _of(ends, "publisher", topic):
            yield f"Subscriber without publisher detected on {topic}."


def _misfits(ends: list[Endpoint]) -> Iterator[str]:
    for topic in _names(ends):
        for publisher, subscription in _pairs(ends, topic):
            reason = _reason(publisher, subscription)
            if reason:
                yield f"ERROR: QoS compatibility error found on topic '{topic}': {reason}"


def _reason(publisher: Endpoint, subscription: Endpoint) -> str:
    found = refusal(publisher.qos, subscription.qos)
    if found is None:
        return ""
    policy, offered, wanted = found
    return f"{publisher.node} publishes {offer(policy, offered)}, and {subscription.node} asks for {wanted}"


def _show(system: System, title: str, rows: list[tuple[str, object]]) -> None:
    longest = max((len(name) for name, _ in rows), default=0)
    width = longest + 4 if longest >= 8 else 8
    system.say("\n".join([f"\n   {title}", *(f"{name:{width}}: {value}" for name, value in rows)]))


def _platform(system: System, ends: list[Endpoint]) -> None:
    rows = [
        ("system", platform.system()),
        ("platform info", platform.platform()),
        ("release", platform.release()),
        ("processor", platform.processor()),
        ("ROS domain", os.environ.get("ROS_DOMAIN_ID") or "0"),
    ]
    _show(system, "PLATFORM INFORMATION", rows)


def _middleware(system: System, ends: list[Endpoint]) -> None:
    _show(system, "RMW MIDDLEWARE", [("middleware name", get_rmw_implementation_identifier())])
    rows: list[tuple[str, object]] = []
    for topic in _names(ends):
        for publisher, subscription in _pairs(ends, topic):
            rows += [
                ("topic [type]", f"{topic} [{publisher.type}]"),
                ("publisher node", publisher.node.rsplit("/", 1)[1]),
                ("subscriber node", subscription.node.rsplit("/", 1)[1]),
                ("compatibility status", _reason(publisher, subscription) or "OK"),
            ]
    rows = rows or [("compatibility status", "No publisher/subscriber pairs found")]
    _show(system, "QOS COMPATIBILITY LIST", rows)


def _topics(system: System, ends: list[Endpoint]) -> None:
    rows: list[tuple[str, object]] = []
    for topic in _names(ends):
        rows += [
            ("topic", topic),
            ("publisher count", len(_of(ends, "publisher", topic))),
            ("subscriber count", len(_of(ends, "subscription", topic))),
        ]
    _show(system, "TOPIC LIST", rows or [("topic", "none"), ("publisher count", 0), ("subscriber count", 0)])

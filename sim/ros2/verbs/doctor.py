"""ros2 doctor: problems with the connections of a system."""

from __future__ import annotations

import os
import platform
from argparse import Namespace
from collections.abc import Iterator, Sequence
from itertools import product

from rclpy.utilities import get_rmw_implementation_identifier

from sim.evidence import Endpoint
from sim.evidence.qos import offer, refusal
from sim.ros2.group import Group, flag
from sim.ros2.system import System, is_hidden

doctor = Group("doctor", "Check ROS setup and other potential issues")
wtf = Group("wtf", "Use `wtf` as alias to `doctor`", doctor.verbs)  # the same verbs, also those added later
IGNORED_TOPICS = ("/parameter_events", "/rosout")


@doctor.verb(
    "",
    flag("-r", "--report", help="Print all reports."),
    flag("-rf", "--report-failed", help="Print reports of failed checks only."),
    flag("-iw", "--include-warnings", help="Include warnings as failed checks."),
)
def check(system: System, options: Namespace) -> None:
    """Check ROS setup and other potential issues."""
    endpoints = [end for end in system.endpoints if not is_hidden(end.name)]
    reports = {"platform": _platform, "middleware": _middleware, "topic": _topics}
    if options.report:
        for report in reports.values():
            report(system, endpoints)
        return
    warnings, errors = list(_unmatched(endpoints)), list(_incompatible(endpoints))
    for line in (*warnings, *errors):
        system.print_line(f"UserWarning: {line}")
    failed = ["middleware"] if errors else []
    failed += ["topic"] if warnings and options.include_warnings else []
    if not failed:
        system.print_line(f"\nAll {len(reports)} checks passed\n")
        return
    system.print_line(f"\n{len(failed)}/{len(reports)} check(s) failed\n\nFailed modules: {' '.join(failed)}")
    for name in failed if options.report_failed else ():
        reports[name](system, endpoints)


def _of(endpoints: list[Endpoint], kind: str, topic: str) -> list[Endpoint]:
    return [end for end in endpoints if end.kind == kind and end.name == topic]


def _names(endpoints: list[Endpoint]) -> list[str]:
    return sorted(
        {e.name for e in endpoints if e.kind in ("publisher", "subscription")} - set(IGNORED_TOPICS)
    )


def _pairs(endpoints: list[Endpoint], topic: str) -> Iterator[tuple[Endpoint, Endpoint]]:
    return product(_of(endpoints, "publisher", topic), _of(endpoints, "subscription", topic))


def _unmatched(endpoints: list[Endpoint]) -> Iterator[str]:
    for topic in _names(endpoints):
        if not _of(endpoints, "subscription", topic):
            yield f"Publisher without subscriber detected on {topic}."
        elif not _of(endpoints, "publisher", topic):
            yield f"Subscriber without publisher detected on {topic}."


def _incompatible(endpoints: list[Endpoint]) -> Iterator[str]:
    for topic in _names(endpoints):
        for publisher, subscription in _pairs(endpoints, topic):
            reason = _reason(publisher, subscription)
            if reason:
                yield f"ERROR: QoS compatibility error found on topic '{topic}': {reason}"


def _reason(publisher: Endpoint, subscription: Endpoint) -> str:
    mismatch = refusal(publisher.qos, subscription.qos)
    if mismatch is None:
        return ""
    policy, offered, requested = mismatch
    return (
        f"{publisher.node} publishes {offer(policy, offered)}, and {subscription.node} requests {requested}"
    )


def _print_report(system: System, title: str, rows: Sequence[tuple[str, object]]) -> None:
    longest = max((len(name) for name, _ in rows), default=0)
    width = longest + 4 if longest >= 8 else 8
    system.print_line("\n".join([f"\n   {title}", *(f"{name:{width}}: {value}" for name, value in rows)]))


def _platform(system: System, endpoints: list[Endpoint]) -> None:
    rows = [
        ("system", platform.system()),
        ("platform info", platform.platform()),
        ("release", platform.release()),
        ("processor", platform.processor()),
        ("ROS domain", os.environ.get("ROS_DOMAIN_ID") or "0"),
    ]
    _print_report(system, "PLATFORM INFORMATION", rows)


def _middleware(system: System, endpoints: list[Endpoint]) -> None:
    _print_report(system, "RMW MIDDLEWARE", [("middleware name", get_rmw_implementation_identifier())])
    rows: list[tuple[str, object]] = []
    for topic in _names(endpoints):
        for publisher, subscription in _pairs(endpoints, topic):
            rows += [
                ("topic [type]", f"{topic} [{publisher.type}]"),
                ("publisher node", publisher.node.rsplit("/", 1)[1]),
                ("subscriber node", subscription.node.rsplit("/", 1)[1]),
                ("compatibility status", _reason(publisher, subscription) or "OK"),
            ]
    rows = rows or [("compatibility status", "No publisher/subscriber pairs found")]
    _print_report(system, "QOS COMPATIBILITY LIST", rows)


def _topics(system: System, endpoints: list[Endpoint]) -> None:
    rows: list[tuple[str, object]] = []
    for topic in _names(endpoints):
        rows += [
            ("topic", topic),
            ("publisher count", len(_of(endpoints, "publisher", topic))),
            ("subscriber count", len(_of(endpoints, "subscription", topic))),
        ]
    _print_report(
        system, "TOPIC LIST", rows or [("topic", "none"), ("publisher count", 0), ("subscriber count", 0)]
    )

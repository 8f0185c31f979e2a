"""Records what the other process reports about its own nodes: log lines, exceptions, callbacks and so on.

No other process can verify these reports, so they are only validated, shortened and counted.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from sim.evidence import (
    FACTS,
    UNMATCHED,
    BusyLoop,
    CallbackError,
    CallbackRun,
    Departure,
    LogLine,
    ParameterName,
    TimerInfo,
    UndeliveredMessage,
)
from sim.nanoseconds import SECOND
from sim.ros.fibers.choices import MOST_DEPARTURES
from sim.ros.recorder.recorder import LEVELS, MAX_LOG_LINES
from sim.ros.remote.validation import ProtocolError, TextBudget, valid_float, valid_list

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

MAX_REPORTS_PER_MESSAGE = 100_000  # of each kind
MAX_REPORTS_PER_RUN = 2_000_000
MAX_TIMER_PERIOD = 1e9  # s
KINDS = ("timer", "subscription", "service", "client", "action", "event", "guard condition", "task")

DEPARTURES = ("turn", "callback", "message", "start", "thread")
DEPARTURE_ID = re.compile("[0-9a-f]{6}")


class SelfReports:
    """Writes the reports into the recording of one run."""

    def __init__(self, engine: Engine, texts: TextBudget) -> None:
        self._engine, self._recording, self._texts = engine, engine.recording, texts
        self._count = 0
        # Kind -> number of fields and what records them. With 0 fields a report is a single value.
        self._kinds: dict[str, tuple[int, Callable[..., None]]] = {
            "nodes": (0, self._node_created),
            "timers": (3, self._timer),
            "logs": (3, self._log),
            "prints": (0, self._printed),
            "errors": (5, self._error),
            "busy_loops": (2, self._busy_loop),
            "unheard": (2, self._unheard),
            "parameters": (3, self._parameter),
            "node_facts": (2, self._node_fact),
            "callbacks": (5, self._callback),
            "departures": (5, self._departure),
        }

    def record(self, reports: dict[str, Any]) -> None:
        """Record the reports of one message, given by kind. Raises ProtocolError for an invalid report."""
        for kind, (width, write) in self._kinds.items():
            if kind in reports:
                for report in self._valid(reports[kind], kind, width):
                    write(*report)

    def _valid(self, reports: Any, kind: str, width: int) -> list[Any]:
        valid = valid_list(reports, kind, MAX_REPORTS_PER_MESSAGE, width)
        self._count += len(valid)
        if self._count > MAX_REPORTS_PER_RUN:
            raise ProtocolError(f"more than {MAX_REPORTS_PER_RUN} log lines, callbacks and other reports")
        return valid if width else [(report,) for report in valid]

    @property
    def _now(self) -> float:
        return self._engine.recorder.now

    def _node(self, name: Any) -> str:
        return self._texts.name(name, "a node's name")

    def _name(self, name: Any) -> str:
        return self._texts.name(name, "a name")

    # -- kinds of reports ----------------------------------------------------------------------------

    def _node_created(self, node: Any) -> None:
        self._engine.recorder.node_named(self._node(node), from_course=False)

    def _timer(self, node: Any, period: Any, callback: Any) -> None:
        seconds = valid_float(period, "a timer's period", 0, MAX_TIMER_PERIOD)
        timer = TimerInfo(self._node(node), seconds, self._name(callback))
        self._recording.graph.timers.append(timer)

    def _log(self, level: Any, logger: Any, line: Any) -> None:
        if level not in LEVELS.values():
            raise ProtocolError("a log line of unknown level")
        logger, line = self._name(logger), self._texts.take(line, "a log line")
        if len(self._recording.logs) < MAX_LOG_LINES:
            self._recording.logs.append(LogLine(self._now, level, logger, line))

    def _printed(self, line: Any) -> None:
        self._engine.recorder.add_stdout(self._texts.take(line, "a print"))

    def _error(self, *parts: Any) -> None:
        texts = (self._texts.take(part, "an error") for part in parts)
        self._recording.errors.append(CallbackError(self._now, *texts))

    def _busy_loop(self, node: Any, place: Any) -> None:
        loop = BusyLoop(self._now, self._node(node), self._texts.take(place, "a busy loop"))
        self._recording.busy_loops.append(loop)

    def _unheard(self, node: Any, topic: Any) -> None:
        self._recording.undelivered.append(UndeliveredMessage(self._now, self._node(node), self._node(topic)))

    def _parameter(self, node: Any, name: Any, declared: Any) -> None:
        parameter = ParameterName(self._now, self._node(node), self._name(name), bool(declared))
        self._recording.parameters.append(parameter)

    def _node_fact(self, node: Any, fact: Any) -> None:
        topics = fact.removeprefix(UNMATCHED).split() if isinstance(fact, str) else []
        unmatched = fact == " ".join([UNMATCHED, *topics]) and all(map(self._name, topics))
        if fact not in FACTS and not unmatched:
            raise ProtocolError("an unknown fact of a node")
        self._engine.recorder.fact(self._node(node), fact)

    def _callback(self, began: Any, lasted: Any, node: Any, callback: Any, kind: Any) -> None:
        if kind not in KINDS:
            raise ProtocolError("a callback of unknown kind")
        now = self._now
        begin = valid_float(began, "the beginning of a callback", 0, now)
        length = valid_float(lasted, "a callback's duration", 0, now - begin + 1 / SECOND)
        run = CallbackRun(begin, length, self._name(node), self._name(callback), kind)
        self._recording.callbacks.append(run)

    def _departure(self, stamp: Any, node: Any, kind: Any, text: Any, id_: Any) -> None:
        if kind not in DEPARTURES or not isinstance(id_, str) or not DEPARTURE_ID.fullmatch(id_):
            raise ProtocolError("a departure of unknown kind")
        at = valid_float(stamp, "the time of a departure", 0, self._now)
        found = Departure(at, self._name(node), kind, self._texts.take(text, "a departure"), id_)
        if len(self._recording.departures) < MOST_DEPARTURES:
            self._recording.departures.append(found)

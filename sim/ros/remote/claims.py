"""What the other side's nodes say of themselves (log lines, exceptions, callbacks and the like).

Nobody else can know whether it is so: it is looked at, cut to size and counted.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from sim.evidence import (
    BusyLoop,
    CallbackError,
    CallbackRun,
    LogLine,
    ParameterName,
    TimerInfo,
    UndeliveredMessage,
)
from sim.nanoseconds import SECOND
from sim.ros.recorder.recorder import LEVELS, MAX_LOG_LINES
from sim.ros.remote.checked import Nonsense, Texts, number, rows

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

MOST_CLAIMS = 100_000  # of a kind, in one message
ALL_CLAIMS = 2_000_000  # in a run
MOST_PERIOD = 1e9  # s, of a timer
KINDS = ("timer", "subscription", "service", "client", "action", "event", "guard condition", "task")


class Claims:
    """Writes them into the recording of one run. texts: those of the run."""

    def __init__(self, engine: Engine, texts: Texts) -> None:
        self._engine, self._recording, self._texts = engine, engine.recording, texts
        self._count = 0
        # What can be claimed: of how many parts, and what writes it down. With no parts it is one thing.
        self._kinds: dict[str, tuple[int, Callable[..., None]]] = {
            "nodes": (0, self._made),
            "timers": (3, self._timer),
            "logs": (3, self._log),
            "prints": (0, self._printed),
            "errors": (5, self._error),
            "busy_loops": (2, self._busy_loop),
            "unheard": (2, self._unheard),
            "parameters": (3, self._parameter),
            "callbacks": (5, self._callback),
        }

    def believe(self, claims: dict[str, Any]) -> None:
        """Write down what came in one message, by kind. Raises Nonsense for what can't be."""
        for kind, (width, write) in self._kinds.items():
            if kind in claims:
                for claim in self._claimed(claims[kind], kind, width):
                    write(*claim)

    def _claimed(self, claims: Any, kind: str, width: int) -> list[Any]:
        found = rows(claims, kind, MOST_CLAIMS, width)
        self._count += len(found)
        if self._count > ALL_CLAIMS:
            raise Nonsense(f"more than {ALL_CLAIMS} log lines, callbacks and the like")
        return found if width else [(claim,) for claim in found]

    @property
    def _now(self) -> float:
        return self._engine.recorder.now

    def _node(self, name: Any) -> str:
        return self._texts.name(name, "a node's name")

    def _name(self, name: Any) -> str:
        return self._texts.name(name, "a name")

    # -- what is claimed -----------------------------------------------------------------------------

    def _made(self, node: Any) -> None:
        self._engine.recorder.named(self._node(node), from_course=False)

    def _timer(self, node: Any, period: Any, callback: Any) -> None:
        seconds = number(period, "a timer's period", 0, MOST_PERIOD)
        timer = TimerInfo(self._node(node), seconds, self._name(callback))
        self._recording.graph.timers.append(timer)

    def _log(self, level: Any, logger: Any, line: Any) -> None:
        if level not in LEVELS.values():
            raise Nonsense("a log line of no known level")
        logger, line = self._name(logger), self._texts.take(line, "a log line")
        if len(self._recording.logs) < MAX_LOG_LINES:
            self._recording.logs.append(LogLine(self._now, level, logger, line))

    def _printed(self, line: Any) -> None:
        self._engine.recorder.printed(self._texts.take(line, "a print"))

    def _error(self, *parts: Any) -> None:
        told = (self._texts.take(part, "an error") for part in parts)
        self._recording.errors.append(CallbackError(self._now, *told))

    def _busy_loop(self, node: Any, place: Any) -> None:
        loop = BusyLoop(self._now, self._node(node), self._texts.take(place, "a busy loop"))
        self._recording.busy_loops.append(loop)

    def _unheard(self, node: Any, topic: Any) -> None:
        self._recording.undelivered.append(UndeliveredMessage(self._now, self._node(node), self._node(topic)))

    def _parameter(self, node: Any, name: Any, declared: Any) -> None:
        named = ParameterName(self._now, self._node(node), self._name(name), bool(declared))
        self._recording.parameters.append(named)

    def _callback(self, began: Any, lasted: Any, node: Any, callback: Any, kind: Any) -> None:
        if kind not in KINDS:
            raise Nonsense("a callback of no known kind")
        now = self._now
        begin = number(began, "the beginning of a callback", 0, now)
        length = number(lasted, "a callback's duration", 0, now - begin + 1 / SECOND)
        run = CallbackRun(begin, length, self._name(node), self._name(callback), kind)
        self._recording.callbacks.append(run)

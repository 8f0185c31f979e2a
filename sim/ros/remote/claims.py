"""What the other side's nodes say of themselves (log lines, exceptions, callbacks and the like).

Nobody else can know whether it is so: it is looked at, cut to size and counted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sim.evidence import BusyLoop, CallbackError, CallbackRun, LogLine, ParameterName, TimerInfo, Unheard
from sim.nanoseconds import SECOND
from sim.ros.recorder.recorder import LEVELS, MAX_LOG_LINES
from sim.ros.remote.checked import MOST_NAME, Nonsense, Texts, number, rows

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

    def believe(self, claims: dict[str, Any]) -> None:
        """Write down what came in one message, by kind. Raises Nonsense for what can't be."""
        for (name,) in self._claimed(claims, "nodes", 0):
            self._engine.recorder.named(self._node(name), ours=False)
        for node, period, callback in self._claimed(claims, "timers", 3):
            seconds = number(period, "a timer's period", 0, MOST_PERIOD)
            timer = TimerInfo(self._node(node), seconds, self._name(callback))
            self._recording.graph.timers.append(timer)
        for level, logger, line in self._claimed(claims, "logs", 3):
            self._log(level, logger, line)
        for (line,) in self._claimed(claims, "prints", 0):
            self._engine.recorder.printed(self._texts.take(line, "a print"))
        for row in self._claimed(claims, "errors", 5):
            told = (self._texts.take(part, "an error") for part in row)
            self._recording.errors.append(CallbackError(self._now, *told))
        for node, place in self._claimed(claims, "busy_loops", 2):
            loop = BusyLoop(self._now, self._node(node), self._texts.take(place, "a busy loop"))
            self._recording.busy_loops.append(loop)
        for node, topic in self._claimed(claims, "unheard", 2):
            self._recording.unheard.append(Unheard(self._now, self._node(node), self._node(topic)))
        for node, name, declared in self._claimed(claims, "parameters", 3):
            named = ParameterName(self._now, self._node(node), self._name(name), bool(declared))
            self._recording.parameters.append(named)
        for began, lasted, node, callback, kind in self._claimed(claims, "callbacks", 5):
            self._callback(began, lasted, node, callback, kind)

    @property
    def _now(self) -> float:
        return self._engine.recorder.now

    def _log(self, level: Any, logger: Any, line: Any) -> None:
        if level not in LEVELS.values():
            raise Nonsense("a log line of no known level")
        logger, line = self._name(logger), self._texts.take(line, "a log line")
        if len(self._recording.logs) < MAX_LOG_LINES:
            self._recording.logs.append(LogLine(self._now, level, logger, line))

    def _callback(self, began: Any, lasted: Any, node: Any, callback: Any, kind: Any) -> None:
        if kind not in KINDS:
            raise Nonsense("a callback of no known kind")
        begin = number(began, "the beginning of a callback", 0, self._now)
        length = number(lasted, "a callback's duration", 0, self._now - begin + 1 / SECOND)
        run = CallbackRun(begin, length, self._name(node), self._name(callback), kind)
        self._recording.callbacks.append(run)

    def _claimed(self, claims: dict[str, Any], name: str, width: int) -> list[Any]:
        """Claims of a kind; with no width, each is one thing and not a list."""
        if name not in claims:
            return []
        found = rows(claims[name], name, MOST_CLAIMS, width)
        self._count += len(found)
        if self._count > ALL_CLAIMS:
            raise Nonsense(f"more than {ALL_CLAIMS} log lines, callbacks and the like")
        return found if width else [(item,) for item in found]

    def _node(self, name: Any) -> str:
        return self._texts.take(name, "a node's name", MOST_NAME)

    def _name(self, name: Any) -> str:
        return self._texts.take(name, "a name", MOST_NAME)

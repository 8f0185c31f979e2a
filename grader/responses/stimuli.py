"""What the course's programs send, and what the student's programs publish in response."""

import bisect
import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from grader.checks.check import Missed
from grader.checks.no_data import no_data
from grader.responses.comparison import same, text_of
from grader.responses.window import EDGE, Row, Window
from sim.evidence import Call, Message, Recording, Seconds
from sim.order import SPREAD


def from_course(run: Recording, topic: str, *, at_least: int = 1, settled: Seconds = 0.0,
                what: str = "") -> list[Message]:
    """Return the messages that the course's programs published on a topic.

    Their stamps are those at which the student's programs received them; see `Recording.received`.
    settled: leave out those of the last seconds of the run, which had no time for a response.
    what: their name in a sentence; by default "messages on" the topic. Raises as `no_data` for fewer.
    """
    found = run.received(topic)
    if settled:
        found = [row for row in found if Window.after(row.stamp, settled).is_over(run)]
    if len(found) < at_least:
        saw = f"{len(found)}" if found else "none"
        raise no_data(run, what or f"messages on {topic}", saw, run.graph.publishers(topic))
    return found


def from_student(run: Recording, topic: str) -> list[Message]:
    """Return the messages that the student's programs published on a topic."""
    return [row for row in run.messages(topic) if not row.from_course]


def requests_from_course(run: Recording, service: str, *, at_least: int = 1, what: str = "") -> list[Call]:
    """Return the requests that the course's programs sent to a service. Raises as `no_data` for fewer."""
    calls = run.calls_of(service)
    found = [call for call in calls if call.requested_by_course and call.requested is not None]
    if len(found) < at_least:
        clients = run.graph.ends("client", service)
        raise no_data(run, what or f"requests to {service}", f"{len(found)}", clients)
    return found


def last_before(rows: Sequence[Row], stamp: Seconds) -> Row | None:
    """Return the last row that is not later than a stamp, or None; the rows are in their order."""
    index = bisect.bisect_right(rows, stamp + EDGE, key=lambda row: row.stamp)
    return rows[index - 1] if index else None


@dataclass(frozen=True)
class Stimulus:
    """A message of the course, and what the student's programs published within its window.

    topic: on which the responses are. responses: in their order.
    """

    message: Message
    window: Window
    topic: str
    responses: tuple[Message, ...]

    @property
    def stamp(self) -> Seconds:
        """Return when it was published."""
        return self.message.stamp

    @property
    def value(self) -> Any:
        """The message object that the course published."""
        return self.message.message

    def values(self, field: str = "data") -> list[Any]:
        """Return a field of each response, such as "data" or "linear.x"."""
        return [_field(row.message, field) for row in self.responses]

    def expects(self, wanted: Any, *, field: str = "data", tolerance: float = 1e-6, hint: str = "",
                **about: Any) -> None:
        """Require a response with this value in a field; raise Missed if there is none.

        about: further arguments of `Missed`, such as `credit`.
        """
        if not any(same(value, wanted, tolerance) for value in self.values(field)):
            expected = f"{text_of(wanted)} on {self.topic} within {self.within:g} s of {self.stamp:.3g} s"
            raise Missed(expected, self.seen(field), hint, about=(self,), **about)

    def expects_nothing(self, expected: str, hint: str = "", *, field: str = "data", saw: str = "") -> None:
        """Require that nothing is published in response; raise Missed if something is.

        saw: what to show of it; by default the values of the field.
        """
        if self.responses:
            raise Missed(expected, saw or self.seen(field), hint, about=(self,))

    def seen(self, field: str = "data") -> str:
        """Return the values of the first responses as text, or "nothing"."""
        return ", ".join(map(text_of, self.values(field)[:5])) or "nothing"

    @property
    def within(self) -> Seconds:
        """The length of its window."""
        return round(self.window.end - self.message.stamp, 9)


@dataclass(frozen=True)
class Stimuli:
    """A topic on which the course publishes, and the topic on which the student must respond.

    within: seconds after a stimulus in which a response counts. not_before: seconds in which none can come
    yet. what: their name in a sentence, such as "positions"; by default "messages on" the topic.
    """

    topic: str
    answered_on: str
    within: Seconds
    not_before: Seconds = 0.0
    what: str = ""

    def __call__(self, run: Recording, *, where: Callable[[Any], bool] | None = None,
                 at_least: int = 1) -> list[Stimulus]:
        """Return the stimuli of a run that had time for a response, each with its responses.

        where: picks them by their message object. Raises as `no_data` for fewer than `at_least`.
        """
        sent = from_course(run, self.topic, at_least=0, settled=self.within)
        chosen = [row for row in sent if where is None or where(row.message)]
        if len(chosen) < at_least:
            expected = self.what or f"messages on {self.topic}"
            raise no_data(run, expected, f"{len(chosen)}", run.graph.publishers(self.topic))
        answers = from_student(run, self.answered_on)
        moments = [row.stamp for row in run.received(self.topic)] if run.order else []
        ends = {stamp: end for stamp, end in itertools.pairwise(moments) if self._is_near(stamp, end)}
        return [self._with_responses(row, answers, ends.get(row.stamp)) for row in chosen]

    def _is_near(self, stamp: Seconds, following: Seconds) -> bool:
        """Return whether the next stimulus, in another order, came early enough to cut this window short."""
        return self.within - 2 * SPREAD < following - stamp <= self.within

    def _with_responses(
        self, message: Message, answers: Sequence[Message], following: Seconds | None
    ) -> Stimulus:
        window = Window(message.stamp + self.not_before, message.stamp + self.within)
        window = window if following is None else window.before(following)
        return Stimulus(message, window, self.answered_on, tuple(window.rows(answers)))


def _field(message: Any, name: str) -> Any:
    for part in name.split("."):
        message = getattr(message, part)
    return message

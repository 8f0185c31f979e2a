"""An exercise on the graph: which nodes publish on a topic?"""

from __future__ import annotations

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.silence.crowd import LATE, PAUSE, crowd
from sim.evidence import Message, Recording, Seconds

STRING = "std_msgs/msg/String"
QUESTION, ANSWER = "/question", "/answer"
LATELY = 0.3  # s; each of ours speaks every 0.2 s
NOBODY = "nobody"

graph = Exercise("graph", "Who publishes there?", seconds=8, companions=crowd, seeds=(1, 2))


class Asked(NamedTuple):
    """A question, what would be right, and the answers that came before the next one."""

    stamp: Seconds
    topic: str
    speakers: tuple[str, ...]  # full names, sorted
    answers: tuple[str, ...]

    @property
    def right(self) -> str:
        """The answer."""
        return ", ".join(self.speakers) or NOBODY


@graph.check(2)
def answers_at_all(run: Recording) -> None:
    """The node hears /question, and publishes String messages on /answer."""
    with hinting(guess="Subscribe to /question, and publish on /answer in the callback: both are String."):
        subscribes(run, QUESTION, STRING)
        publishes(run, ANSWER, STRING)


@graph.check(7, after=answers_at_all)
def names_the_speakers(run: Recording) -> None:
    """Where somebody publishes, one answer names all who do: full names, sorted, each once."""
    asked = [one for one in _asked(run.during(0.0, LATE)) if one.speakers]
    _right(run, asked, "questions about a topic on which somebody publishes")


@graph.check(2, after=names_the_speakers)
def says_nobody(run: Recording) -> None:
    """Where nobody publishes, the answer is “nobody”."""
    asked = [one for one in _asked(run) if not one.speakers]
    _right(run, asked, "questions about a topic on which nobody publishes")


@graph.check(3, after=names_the_speakers)
def knows_who_came_late(run: Recording) -> None:
    """A node that joins while you watch is named from then on, and not before."""
    before, since = _asked(run.during(0.0, LATE)), _asked(run.during(LATE, run.ended.stamp))
    earlier = {one.topic: one.speakers for one in before}
    grown = [one for one in since if one.speakers != earlier.get(one.topic, one.speakers)]
    _right(run, grown, "questions about a topic that somebody has joined")


def _asked(run: Recording) -> list[Asked]:
    """All questions of ours that had time for an answer."""
    told, answers, asked = run.messages(), run.messages(ANSWER), []
    for question in run.messages(QUESTION):
        if not question.from_course or question.stamp > run.ended.stamp - PAUSE:
            continue
        topic, begin = question.message.data, question.stamp
        speakers = sorted({one.sender for one in told if _lately(one, topic, begin)})
        said = [one.message.data for one in answers if begin <= one.stamp < begin + PAUSE - 1e-6]
        asked.append(Asked(begin, topic, tuple(speakers), tuple(said)))
    return asked


def _lately(heard: Message, topic: str, moment: Seconds) -> bool:
    return heard.from_course and heard.topic == topic and moment - LATELY < heard.stamp <= moment + 1e-6


def _right(run: Recording, asked: list[Asked], what: str) -> None:
    if not asked:
        raise no_data(run, what, "none", run.graph.publishers(QUESTION))
    all_named = all(len(one.answers) == 1 and set(_names(one)) == set(one.speakers) for one in asked)
    for one in asked:
        if one.answers != (one.right,):
            expected = f"“{one.right}” for the question at {one.stamp:.3g} s, “{one.topic}”"
            raise Missed(expected, _told(one.answers), _why_wrong(run, one), credit=0.5 * all_named)


def _names(one: Asked) -> list[str]:
    """What stands in the first answer."""
    return [name for name in one.answers[0].split(", ") if name]


def _told(answers: tuple[str, ...]) -> str:
    if len(answers) > 1:
        return f"{len(answers)} answers"
    return f"“{answers[0]}”" if answers else "no answer"


def _why_wrong(run: Recording, one: Asked) -> str:
    """The usual reasons for a wrong answer."""
    if len(one.answers) > 1:
        return "Publish once in the callback, all names in one message: ', '.join(names)."
    if not one.answers:
        return "The callback is called with each question: publish in it, whatever the answer is."
    names = _names(one)
    wanted = set(one.speakers)
    listeners = {end.node for end in run.graph.subscriptions(one.topic)}
    if names and set(names) <= listeners and not set(names) <= wanted:
        return "These nodes listen there. Those who publish: get_publishers_info_by_topic(topic)."
    if not names:
        return f"An empty list of names gives an empty text: publish “{NOBODY}” then."
    if len(names) > len(set(names)):
        return "A node with two publishers is in the list twice: make a set of the names first."
    if set(names) == wanted:
        return "The names are right, and their order isn't: sorted(...) puts them in order."
    if {name.rpartition("/")[2] for name in names} == {name.rpartition("/")[2] for name in wanted}:
        return (
            "The full name begins with the namespace: node_namespace, a slash, node_name. In the namespace / "
            "itself there is only one slash."
        )
    if set(names) < wanted:
        return (
            "Somebody is missing. Ask ROS anew at each question, for nodes come and go; and take all of them."
        )
    return "Ask about the topic that the question names: msg.data."

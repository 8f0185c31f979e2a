"""The graph: which nodes publish on a topic?"""

from collections.abc import Iterable
from typing import NamedTuple

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.silence.graph.speakers import LATE, PAUSE, speakers
from grader.responses import EDGE, Stimuli, Window
from grader.variants import Variants
from sim.evidence import Recording, Seconds

__all__ = ["graph", "speakers"]

STRING = "std_msgs/msg/String"
QUESTION, ANSWER = "/question", "/answer"
LATELY = 0.3  # s; each publisher of the course publishes every 0.2 s

WRONG = {
    "Publish once in the callback, with all names in one message: ', '.join(names).":
        lambda run, one: len(one.answers) > 1,
    "The callback is called for each question: publish in it every time, whatever the answer.":
        lambda run, one: not one.answers,
    "These nodes subscribe to it. To find the publishers: get_publishers_info_by_topic(topic).":
        lambda run, one: (names := set(_names(one))) and not names <= set(one.speakers)
        and names <= {end.node for end in run.graph.subscriptions(one.topic)},
    "An empty list of names makes an empty string: publish “none” "
    "instead.": lambda run, one: not _names(one),
    "A node with two publishers is in the list twice: put the names in a set first.":
        lambda run, one: len(_names(one)) > len(set(_names(one))),
    "The names are right, but their order isn't: use sorted(...).":
        lambda run, one: set(_names(one)) == set(one.speakers),
    "The full name begins with the namespace: node_namespace, a slash, node_name. In the namespace / there "
    "is only one slash.": lambda run, one: _bare(_names(one)) == _bare(one.speakers),
    "A node is missing. Look the topic up again for each question, because nodes come and go; and list all "
    "of them.":
        lambda run, one: set(_names(one)) < set(one.speakers),
    "Look up the topic that the question names: msg.data.": otherwise,
}

graph = Exercise("graph", "Who publishes there?", seconds=8, companions=speakers, seeds=(1, 2),
                 variants=Variants(
    {"between": (", ", "; ", " | "), "sign": ("a comma and a space", "a semicolon and a space", "` | `")},
    {"none": ("none", "empty", "nothing")},
    texts=("separated by {sign}", "/kitchen/arm{between}/lidar", '"{between}".join', "'{between}'.join",
           "`{none}`", '"{none}"', "“{none}”"),
))
questions = Stimuli(QUESTION, answered_on=ANSWER, within=PAUSE - 2 * EDGE)


class GraphQuestion(NamedTuple):
    """A question, the right answer, and the answers before the next question."""

    stamp: Seconds
    topic: str
    speakers: tuple[str, ...]  # full names, sorted
    answers: tuple[str, ...]

    @property
    def right(self) -> str:
        """The answer."""
        return str(graph.drawn.between.join(self.speakers) or graph.drawn.none)


@graph.check(2)
def answers_at_all(run: Recording) -> None:
    """The node subscribes to /question, and publishes String messages on /answer."""
    subscribes(run, QUESTION, STRING)
    publishes(run, ANSWER, STRING)


@graph.check(7, after=answers_at_all, hints=WRONG)
def names_the_publishers(run: Recording) -> None:
    """If the topic has publishers, one answer names all their nodes: full names, sorted, each once."""
    questions = [one for one in _questions(run.during(0.0, LATE)) if one.speakers]
    _right(run, questions, "topics that have publishers", some=True)


@graph.check(2, after=names_the_publishers, hints=WRONG)
def answers_none(run: Recording) -> None:
    """If it has none, the answer is “none”."""
    questions = [one for one in _questions(run) if not one.speakers]
    _right(run, questions, "topics without publishers")


@graph.check(3, after=names_the_publishers, hints=WRONG)
def names_nodes_that_joined(run: Recording) -> None:
    """A node that joins later is named from then on, and not before."""
    before, since = _questions(run.during(0.0, LATE)), _questions(run.during(LATE, run.ended.stamp))
    earlier = {one.topic: one.speakers for one in before}
    grown = [one for one in since if one.speakers != earlier.get(one.topic, one.speakers)]
    _right(run, grown, "topics with new publishers")


def _questions(run: Recording) -> list[GraphQuestion]:
    """All questions of the course that had time for an answer."""
    found = []
    for one in questions(run, at_least=0):
        lately = Window(one.stamp - LATELY, one.stamp).rows(run.messages(one.value.data))
        speakers = sorted({row.sender for row in lately if row.from_course})
        found.append(GraphQuestion(one.stamp, one.value.data, tuple(speakers), tuple(one.values())))
    return found


def _right(run: Recording, questions: list[GraphQuestion], what: str, some: bool = False) -> None:
    """Raise Missed for the first wrong answer; with half of the points, where all have the right nodes.

    some: or some of them.
    """
    if not questions:
        raise no_data(run, what, "none", run.graph.publishers(QUESTION))
    between = graph.drawn.between
    found = [(_bare(between.join(one.answers).split(between)) - {""}, _bare(one.speakers))
             for one in questions]
    named = all(one.answers for one in questions) and all(
        names == right or (some and names and names <= right) for names, right in found)
    for one in questions:
        if one.answers != (one.right,):
            expected = f"“{one.right}” for the question at {one.stamp:.3g} s, “{one.topic}”"
            saw = f"{len(one.answers)} answers"
            if len(one.answers) < 2:
                saw = f"“{one.answers[0]}”" if one.answers else "no answer"
            raise Missed(expected, saw, credit=0.5 * named, about=(one,))


def _names(one: GraphQuestion) -> list[str]:
    """The names in the first answer."""
    return [name for name in one.answers[0].split(graph.drawn.between) if name]


def _bare(names: Iterable[str]) -> set[str]:
    return {name.rpartition("/")[2] for name in names}

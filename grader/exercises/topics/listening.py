"""Exercises on subscribers: a robot that obeys words, and one callback for three topics."""

from __future__ import annotations

from grader.checks import Missed, answers, check, subscribes
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.topics.partners import COMMANDS, Chatterbox, CommandSender
from sim.recording import Heard, LogLine, Recording

STRING, FLOAT64, BOOL = "std_msgs/msg/String", "std_msgs/msg/Float64", "std_msgs/msg/Bool"

COMMAND = "/robot/command"
PRINTED = "What is printed is no log line: use self.get_logger() in place of print(...)."
DOING = {"stand": "standing", "walk": "walking", "stop": "stopping"}


PATIENCE = 0.25  # seconds between a message and its log line; messages follow each other more slowly


@check(points=3)
def listens_to_commands(recording: Recording) -> None:
    """The node listens to String messages on /robot/command."""
    subscribes(recording, COMMAND, STRING)


@check(points=6, after=listens_to_commands)
def obeys(recording: Recording) -> None:
    """`stand`, `walk` and `stop` are answered at info level with standing, walking or stopping."""
    logging = "The word is in msg.data. Compare it with ==, and log with self.get_logger().info(...)."
    with advising(recording, PRINTED if recording.prints else logging):
        answers(
            recording,
            COMMAND,
            lambda heard: DOING[_word(heard)],
            level="INFO",
            within=PATIENCE,
            where=_is_command,
        )


@check(points=4, after=listens_to_commands)
def warns(recording: Recording) -> None:
    """Any other word is answered with a warning that names the word."""
    logging = "In an else: self.get_logger().warning(...), with the word msg.data in the text."
    with advising(recording, PRINTED if recording.prints else logging):
        answers(
            recording,
            COMMAND,
            _word,
            level="WARN",
            within=PATIENCE,
            where=lambda heard: not _is_command(heard),
        )


@check(points=2, after=obeys)
def says_nothing_else(recording: Recording) -> None:
    """A word is answered by its own answer and by no other."""
    for heard in recording.messages(COMMAND):
        for line in _lines_after(recording, heard.stamp):
            if _contradicts(line, _word(heard)):
                raise Missed(
                    f"only {_answer(heard)} after “{_word(heard)}”",
                    f"“{line.text}” ({line.level}) at {line.stamp:.3g} s",
                    "Compare whole words with ==, and use if, elif, else: then exactly one branch runs.",
                )


def _is_command(heard: Heard) -> bool:
    return _word(heard) in COMMANDS


def _word(heard: Heard) -> str:
    return heard.message.data


def _answer(heard: Heard) -> str:
    return f"“{DOING[_word(heard)]}”" if _is_command(heard) else "a warning"


def _lines_after(recording: Recording, stamp: float) -> list[LogLine]:
    return [line for line in recording.logs if stamp <= line.stamp <= stamp + PATIENCE]


def _contradicts(line: LogLine, word: str) -> bool:
    if line.level != "INFO":
        return word in COMMANDS
    others = [doing for command, doing in DOING.items() if command != word]
    return any(doing in line.text.lower() for doing in others)


commands = Exercise(
    "commands",
    "A robot that listens",
    [listens_to_commands, obeys, warns, says_nothing_else],
    seconds=10,
    companions=[CommandSender],
    seeds=(1, 2),
)


CHATTERS = {"/chatter0": STRING, "/chatter1": FLOAT64, "/chatter2": BOOL}


@check(points=6)
def listens_to_all_three(recording: Recording) -> None:
    """The node listens to /chatter0 (String), /chatter1 (Float64) and /chatter2 (Bool)."""
    for found, (topic, kind) in enumerate(CHATTERS.items()):
        try:
            with advising(recording, "Make one subscription for each topic, in a loop or one by one."):
                subscribes(recording, topic, kind)
        except Missed as missed:
            raise Missed(missed.expected, missed.saw, missed.hint, credit=found / len(CHATTERS)) from None


@check(points=6, after=listens_to_all_three)
def knows_the_topic(recording: Recording) -> None:
    """Each message is logged at info level as `chatter0: word`: its topic, a colon, a space and its value."""
    missed = {topic: heard for topic in CHATTERS if (heard := _first_untold(recording, topic))}
    if missed:
        first = min(missed.values(), key=lambda heard: heard.stamp)
        expected = f"“{_told(first, first.topic)}” at level INFO after the message at {first.stamp:.3g} s"
        right = len(CHATTERS) - len(missed)
        credit = right / len(CHATTERS) if right > 1 else 0.0  # a single one may be right by chance
        with advising(recording, 'Log each message: self.get_logger().info(f"{topic}: {msg.data}").'):
            raise Missed(expected, *_told_instead(recording, first), credit=credit)


@check(points=3, after=knows_the_topic)
def uses_one_callback(recording: Recording) -> None:
    """One callback serves all three topics."""
    nodes = {end.node for topic in CHATTERS for end in recording.graph.subscriptions(topic)}
    names = {run.callback for run in recording.callbacks if run.kind == "subscription" and run.node in nodes}
    if len(names) > 1:
        raise Missed(
            "one callback for the three topics",
            ", ".join(sorted(names)),
            "Write one method with a second parameter, `def hear(self, msg, topic):`, and give it the topic "
            "with a lambda or functools.partial.",
        )


def _told(heard: Heard, topic: str) -> str:
    return f"{topic.lstrip('/')}: {heard.message.data}"


def _first_untold(recording: Recording, topic: str) -> Heard | None:
    return next((h for h in recording.messages(topic) if not _is_told(recording, h, topic)), None)


def _is_told(recording: Recording, heard: Heard, topic: str) -> bool:
    wanted = _told(heard, topic).lower()
    lines = _lines_after(recording, heard.stamp)
    return any(line.level == "INFO" and wanted in line.text.lower() for line in lines)


def _told_instead(recording: Recording, heard: Heard) -> tuple[str, str]:
    """What was said about a message, and a hint where the reason is known."""
    lines = _lines_after(recording, heard.stamp)
    if any("source_timestamp" in line.text for line in lines):
        return (
            "details of the message's way where its topic should be",
            "A callback with two parameters gets such details as the second. "
            "Give it the topic: partial(self.hear, topic=topic).",
        )
    saw = ", ".join(f"“{line.text}” ({line.level})" for line in lines) or "no line"
    if heard.topic != "/chatter2" and _is_told(recording, heard, "/chatter2"):
        return saw, (
            "Every message is said to come from /chatter2. A lambda made in a loop reads the variable when "
            "it is called, after the loop. Write `lambda msg, topic=topic: ...`, or use partial."
        )
    return saw, ""


chatters = Exercise(
    "chatters",
    "Three topics, one callback",
    [listens_to_all_three, knows_the_topic, uses_one_callback],
    seconds=10,
    companions=[Chatterbox],
    seeds=(1, 2),
)

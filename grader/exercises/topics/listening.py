"""Exercises on subscribers: a robot that obeys words, and one callback for three topics."""

from __future__ import annotations

from grader.checks import Missed, answers, hinting, subscribes
from grader.exercise import Exercise
from grader.exercises.topics.partners import COMMANDS, Chatterbox, CommandSender
from sim.evidence import LogLine, Message, Recording

STRING, FLOAT64, BOOL = "std_msgs/msg/String", "std_msgs/msg/Float64", "std_msgs/msg/Bool"
PATIENCE = 0.25  # seconds between a message and its log line; messages follow each other more slowly


def _lines_after(run: Recording, heard: Message) -> list[LogLine]:
    return run.during(heard.stamp, heard.stamp + PATIENCE).logs


commands = Exercise("commands", "A robot that listens", seconds=10, companions=[CommandSender], seeds=(1, 2))
COMMAND = "/robot/command"
DOING = dict(zip(COMMANDS, ("standing", "walking", "stopping"), strict=True))
PRINTED = "What is printed is not logged: use self.get_logger() instead of print(...)."


@commands.check(3)
def listens_to_commands(run: Recording) -> None:
    """The node listens to String messages on /robot/command."""
    subscribes(run, COMMAND, STRING)


@commands.check(6, after=listens_to_commands)
def obeys(run: Recording) -> None:
    """`stand`, `walk` and `stop` are answered at info level with standing, walking or stopping."""
    logging = "The word is in msg.data. Compare it with ==, and log with self.get_logger().info(...)."
    with hinting(guess=PRINTED if run.prints else logging):
        answers(
            run, COMMAND, lambda heard: DOING[_word(heard)], level="INFO", within=PATIENCE, where=_is_command
        )
    asked = list(filter(_is_command, run.messages(COMMAND)))
    doubtful = [heard for heard in asked if _said_otherwise(run, heard)]
    if len(doubtful) > len(asked) / 2:
        heard = doubtful[0]
        raise Missed(
            f"only “{DOING[_word(heard)]}” after “{_word(heard)}”",
            f"“{_said_otherwise(run, heard)}” at {heard.stamp:.3g} s",
            "To say everything is to answer nothing. With if, elif, else exactly one branch runs.",
        )


def _said_otherwise(run: Recording, heard: Message) -> str:
    """A line at info level that says what another command asks for; "" for none."""
    lines = [line for line in _lines_after(run, heard) if line.level == "INFO"]
    return next((line.text[:60] for line in lines if _contradicts(line, _word(heard))), "")


@commands.check(4, after=listens_to_commands)
def warns(run: Recording) -> None:
    """Any other word is answered with a warning that names the word."""
    logging = "In an else: self.get_logger().warning(...), with the word msg.data in the text."
    with hinting(guess=PRINTED if run.prints else logging):
        answers(
            run, COMMAND, _word, level="WARN", within=PATIENCE, where=lambda heard: not _is_command(heard)
        )


@commands.check(2, after=obeys)
def says_nothing_else(run: Recording) -> None:
    """A word is answered by its own answer and by no other."""
    for heard in run.messages(COMMAND):
        for line in _lines_after(run, heard):
            if _contradicts(line, _word(heard)):
                answer = f"“{DOING[_word(heard)]}”" if _is_command(heard) else "a warning"
                raise Missed(
                    f"only {answer} after “{_word(heard)}”",
                    f"“{line.text}” ({line.level}) at {line.stamp:.3g} s",
                    "Compare whole words with ==, and use if, elif, else: then exactly one branch runs.",
                )


def _word(heard: Message) -> str:
    return heard.message.data


def _is_command(heard: Message) -> bool:
    return _word(heard) in COMMANDS


def _contradicts(line: LogLine, word: str) -> bool:
    if line.level != "INFO":
        return word in COMMANDS
    others = [doing for command, doing in DOING.items() if command != word]
    return any(doing in line.text.lower() for doing in others)


chatters = Exercise(
    "chatters", "Three topics, one callback", seconds=10, companions=[Chatterbox], seeds=(1, 2)
)
CHATTERS = {"/chatter0": STRING, "/chatter1": FLOAT64, "/chatter2": BOOL}


@chatters.check(4, guess="Make one subscription for each topic, in a loop or one by one.")
def listens_to_all_three(run: Recording) -> None:
    """The node listens to /chatter0 (String), /chatter1 (Float64) and /chatter2 (Bool)."""
    for found, (topic, kind) in enumerate(CHATTERS.items()):
        try:
            subscribes(run, topic, kind)
        except Missed as missed:
            missed.credit = found / len(CHATTERS)
            raise


@chatters.check(
    8,
    after=listens_to_all_three,
    guess='Log each message: self.get_logger().info(f"{topic}: {msg.data}").',
)
def knows_the_topic(run: Recording) -> None:
    """Each message is logged at info level as `chatter0: word`: its topic, a colon, a space and its value."""
    untold = [heard for topic in CHATTERS if (heard := _first_untold(run, topic))]
    if untold:
        first, right = min(untold, key=lambda heard: heard.stamp), len(CHATTERS) - len(untold)
        expected = f"“{_told(first, first.topic)}” at level INFO after the message at {first.stamp:.3g} s"
        credit = right / len(CHATTERS) if right > 1 else 0.0  # a single one may be right by chance
        raise Missed(expected, *_told_instead(run, first), credit=credit)


def _first_untold(run: Recording, topic: str) -> Message | None:
    return next((heard for heard in run.messages(topic) if not _is_told(run, heard, topic)), None)


def _is_told(run: Recording, heard: Message, topic: str) -> bool:
    wanted = _told(heard, topic).lower()
    return any(line.level == "INFO" and wanted in line.text.lower() for line in _lines_after(run, heard))


def _told(heard: Message, topic: str) -> str:
    return f"{topic.lstrip('/')}: {heard.message.data}"


def _told_instead(run: Recording, heard: Message) -> tuple[str, str]:
    """What was said about a message, and a hint where the reason is known."""
    lines = _lines_after(run, heard)
    if any("source_timestamp" in line.text for line in lines):
        return (
            "details of the message's way where its topic should be",
            "A callback with two parameters gets such details as the second. "
            "Give it the topic: partial(self.hear, topic=topic).",
        )
    saw = ", ".join(f"“{line.text}” ({line.level})" for line in lines) or "no line"
    if heard.topic != "/chatter2" and _is_told(run, heard, "/chatter2"):
        return saw, (
            "Every message is said to come from /chatter2. A lambda made in a loop reads the variable when "
            "it is called, after the loop. Write `lambda msg, topic=topic: ...`, or use partial."
        )
    if not run.logs:
        return saw, "Nothing is logged at all. Debug lines are hidden: use self.get_logger().info(...)."
    if not lines and heard.message.data is False and run.graph.subscriptions(heard.topic):
        return saw, (
            "False is a value like any other, but `if msg.data:` lets only True pass: "
            "log each message, whatever it says."
        )
    return saw, ""


@chatters.check(3, after=knows_the_topic)
def uses_one_callback(run: Recording) -> None:
    """One callback serves all three topics."""
    nodes = {end.node for topic in CHATTERS for end in run.graph.subscriptions(topic)}
    names = {ran.callback for ran in run.callbacks if ran.kind == "subscription" and ran.node in nodes}
    if len(names) > 1:
        raise Missed(
            "one callback for the three topics",
            ", ".join(sorted(names)),
            "Write one method with a second parameter, `def hear(self, msg, topic):`, and give it the topic "
            "with a lambda or functools.partial.",
        )

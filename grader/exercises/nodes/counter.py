"""A node that counts."""

from grader.checks import LogMatch, Missed, come_every, logs, named
from grader.checks.fields import listed
from grader.exercise import Exercise
from grader.variants import Variants
from sim.evidence import Recording

counter = Exercise("counter", "A node that counts", seconds=4, variants=Variants(
    {"period": (0.5, 0.25, 0.2), "often": ("twice", "four times", "five times"),
     "first": ("0.500", "0.250", "0.200"), "second": ("1.000", "0.500", "0.400")},
    {"word": ("Count", "Step", "Tick")},
    texts=("{period:g} s", "create_timer({period:g}, ", "{often} a second", "{word}: "),
    elsewhere=("[{first}] [counter]: {word}: 1", "[{second}] [counter]: {word}: 2"),
))


@counter.check(3)
def called_counter(run: Recording) -> None:
    """The node is called counter."""
    named(run, "/counter")


@counter.check(5)
def logs_counts(run: Recording) -> list[LogMatch]:
    """The node logs lines like “Count: 1” at info level."""
    word = counter.drawn.word
    return logs(run, rf"^\W*?{word}\W+(\d+)", level="INFO", example=f"{word}: 1")


@counter.check(6, after=logs_counts)
def counts_up(run: Recording, lines: list[LogMatch]) -> None:
    """The count starts at 1 and goes up by 1 with each line."""
    counts = [int(line.groups[0]) for line in lines]
    wanted = list(range(1, len(counts) + 1))
    if counts == wanted:
        return
    hint = "How much does your code add to the count, and how often?"
    if len(counts) > 1 and len(set(counts)) == 1:
        hint = ("A local variable is gone when its method returns: create self.count in __init__, and add to "
                "that.")
    elif counts[0] == 0:
        hint = "The first count is 1: add before you log."
    raise Missed(listed(wanted), listed(counts), hint)


@counter.check(6, after=logs_counts)
def counts_every_half_second(run: Recording, lines: list[LogMatch]) -> None:
    """A count comes every 0.5 s."""
    come_every(run, lines, counter.drawn.period)

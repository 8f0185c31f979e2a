"""The gate of an exercise, and the files of a new one.

python -m tests.exercises topics/imu         tries it: page, adversaries, hints, vocabulary, seeds and orders
python -m tests.exercises imu                the same, where only one exercise has this name
python -m tests.exercises --new topics imu   writes its folders, and its cells into the assignment's notebook
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator

import pytest

from sim.suggestions import unknown_name
from tests.exercises.builds import kept_builds
from tests.exercises.new_exercise import write_new
from tests.exercises.orders import fallen_short_in_orders
from tests.exercises.score_tables import ROOT, folder_of, with_pages, write_page
from tests.exercises.seeds import exercise_of, fallen_short

SHARED = "adversaries", "changed_recordings", "hints", "last_hints", "silence_is_no_stop"
TOOLING = "tests/rules/test_rules.py", "tests/tooling/test_vocabulary.py", "tests/tooling/test_sizes.py"
REPEATED = "every_students_seeds or every_order or no_run_shows_more or budget"  # the gate tries fewer
SIMULATED, FEWEST, MOST = 240.0, 3, 20  # s that all seeds and all orders simulate; how many are tried


def place_of(name: str) -> tuple[str, str]:
    """The topic and the name of an exercise. Raises LookupError for one that isn't there, or for several."""
    known = sorted(path.parts[-3:-1] for path in ROOT.glob("tests/exercises/*/*/students.py"))
    found = [place for place in known if name in ("/".join(place), place[1])]
    if len(found) > 1:
        raise LookupError(f"several exercises are called {name}: write {' or '.join(map('/'.join, found))}")
    if not found:
        raise LookupError(unknown_name("exercise", name, ["/".join(place) for place in known]))
    return found[0]


def repeats(topic: str, name: str, number: int = 0) -> Iterator[str]:
    """What right nodes and the solution miss with other seeds, and in other orders.

    number: of seeds, and of orders; 0 for as many as fit into the usual time.
    """
    from tests.exercises.assignment import simulated  # not before pytest has rewritten its assertions

    number = number or min(max(int(SIMULATED / simulated(exercise_of(topic, name))), FEWEST), MOST)
    with kept_builds():
        yield from fallen_short(topic, name, range(number))
        yield from fallen_short_in_orders(topic, name, range(1, number + 1))


def gate(topic: str, name: str, number: int = 0) -> int:
    """Write the page if there is none yet, and try everything; the exit status of it."""
    if (topic, name) not in with_pages():
        write_page(topic, name)
        print(f"Written: {folder_of(topic, name)}/page.txt. Read it as a student would.", flush=True)
    chosen = ["--exercise", f"{topic}/{name}", "-m", "", "-k", f"not ({REPEATED})"]
    files = [f"tests/exercises/test_{each}.py" for each in (topic, *SHARED)]
    failed = pytest.main(["-q", *files, str(folder_of(topic, name)), *TOOLING, *chosen])
    short = list(repeats(topic, name, number))
    print(*(short or ["Right nodes earn everything with other seeds and in other orders."]), sep="\n")
    return int(bool(failed or short))


def main(words: list[str]) -> int:
    """Try an exercise, or begin a new one."""
    parser = argparse.ArgumentParser(prog="python -m tests.exercises", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("--new", action="store_true", help="begin a new exercise: TOPIC NAME")
    help_ = "how many other seeds and orders; without it, as many as take half a minute"
    parser.add_argument("--repeats", type=int, default=0, metavar="N", help=help_)
    parser.add_argument("words", nargs="+", metavar="NAME", help="the exercise's; with --new TOPIC NAME")
    options = parser.parse_args(words)
    try:
        if options.new and len(options.words) == 2:
            print(*write_new(ROOT, *options.words), sep="\n")
            return 0
        if not options.new and len(options.words) == 1:
            return gate(*place_of(options.words[0]), options.repeats)
    except (LookupError, FileExistsError) as error:
        parser.error(str(error))
    parser.error("expected the name of one exercise, or --new TOPIC NAME")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

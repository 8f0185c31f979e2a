"""What a thread dump says together with the program: what each thread holds, and what it waits for."""

import re

from grader.exercises.threads.deadlock.dump_reading import WaitingThread, right_answers, waiting_threads
from grader.exercises.threads.deadlock.given import DEPOT, DUMP


def test_the_threads_of_the_dump():
    assert waiting_threads(DEPOT, DUMP) == [
        WaitingThread("sweep", (), "corridor"),
        WaitingThread("load", (), "response"),
        WaitingThread("down", ("lift",), "corridor"),
        WaitingThread("up", ("corridor",), "lift"),
    ]


def test_the_right_answers_are_those_of_the_circle_and_of_the_response():
    assert right_answers(DEPOT, DUMP) == {"corridor": "up", "lift": "down", "response": "load"}


def test_two_locks_of_one_with_are_held_in_its_block():
    program = "def go():\n    with self.a, self.b:\n        with self.c:\n            work()\n"
    (thread,) = waiting_threads(program, 'Thread 1:\n  File "depot.py", line 3 in go')
    assert thread == WaitingThread("go", ("a", "b"), "c")
    (thread,) = waiting_threads(program, 'Thread 1:\n  File "depot.py", line 4 in go')
    assert thread == WaitingThread("go", ("a", "b", "c"), "response")


def test_each_line_of_the_dump_is_in_the_function_that_it_names():
    lines = DEPOT.splitlines()
    for number, function in re.findall(r'File "depot\.py", line (\d+) in (\w+)', DUMP):
        above = [line.split()[1] for line in lines[: int(number)] if line.lstrip().startswith("def ")]
        assert above[-1].partition("(")[0] == function

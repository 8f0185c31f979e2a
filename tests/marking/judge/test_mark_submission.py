from dataclasses import replace

import nbformat
import pytest

from grader import Exercise, check
from grader.exercises import topics
from grader.marking.errors import UnknownTest
from grader.marking.judge.mark_submission import mark_submission, result_text
from grader.marking.judge.notebook_run import NOT_RUN
from grader.marking.result import Result
from sim.ros.remote.events import MessagePublished
from sim.ros.remote.leader_link import LeaderLink
from tests.marking.assignment import GREETER, RIGHT, hand_in, release, task


@pytest.fixture
def marked(tmp_path, start_student, monkeypatch):
    """Marks a submission with these answers."""
    released = release(tmp_path / "02_two")

    def do(secret: str = "", quick: str = "none has this", student: str = "ann", **answers: str) -> Result:
        texts = {name.replace("_", "-"): text for name, text in answers.items()}
        task = hand_in(tmp_path / student, released, texts)
        result = mark_submission(task, secret, lambda: start_student(quick, begun=False).student)
        return Result.from_json(result_text(result))

    return do


def points(result: Result) -> dict[str, float]:
    return {cell.cell: cell.points for notebook in result.notebooks for cell in notebook.cells}


def cell(result: Result, name: str) -> dict:
    return next(cell for cell in result.notebooks[0].notebook["cells"] if cell["id"] == name)


def text(result: Result, name: str) -> str:
    return "".join(output.get("text", "") for output in cell(result, name)["outputs"])


def test_right_answers_earn_everything(marked):
    result = marked()
    assert (result.reason, result.verdict, result.repairs, result.flags) == ("", "marked", [], [])
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert (result.student, result.assignment, result.key) == ("ann", "02_two", "0" * 64)
    assert text(result, "greeting-see") == f"{NOT_RUN}\n"


def test_the_secret_gives_other_seeds_and_the_same_points(marked):
    public, private = marked(), marked("a secret")
    assert points(private) == points(public)
    digests = [[cell.digests for cell in result.notebooks[0].cells] for result in (public, private)]
    assert digests[0][1] != digests[1][1]


def test_two_students_have_other_seeds_and_the_same_points(marked):
    ann, bob = marked("a secret"), marked("a secret", student="bob")
    assert points(bob) == points(ann)
    digests = [[cell.digests for cell in result.notebooks[0].cells] for result in (ann, bob)]
    assert digests[0][1] != digests[1][1]


def test_marking_again_gives_the_same_result(marked):
    assert marked("a secret").grade_json() == marked("a secret").grade_json()


def test_the_notebook_is_a_valid_one_with_counts_and_outputs(marked):
    result = marked()
    nbformat.validate(nbformat.from_dict(result.notebooks[0].notebook))
    cells = result.notebooks[0].notebook["cells"]
    assert [cell["execution_count"] for cell in cells] == [1, 2, 3, 4, 5, 6]
    shown = cell(result, "greeting-points")["outputs"][-1]
    assert shown["output_type"] == "execute_result"
    assert shown["data"]["text/plain"] == "8"
    assert "8 of 8 points" in shown["data"]["text/html"]


def test_wrong_answers_earn_what_the_score_says(marked):
    result = marked(greeting=GREETER.replace("0.5", "1.0"))
    earned = points(result)
    assert 0 < earned["greeting-points"] < 8
    assert earned["temperature-points"] == 15
    assert result.verdict == "marked"


def test_what_an_unanswered_cell_earns_and_says(marked):
    result = marked(greeting="Greeter = None")
    assert points(result)["greeting-points"] == 0
    shown = cell(result, "greeting-points")["outputs"][-1]["data"]["text/html"]
    assert "This exercise is not started yet" in shown


def test_a_name_that_is_missing_costs_its_own_exercise_only(marked):
    result = marked(greeting="x = 1", greeting_see="print('seen')")
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    outputs = cell(result, "greeting-points")["outputs"]
    assert outputs[0]["traceback"][-1] == "NameError: name 'Greeter' is not defined"
    assert outputs[1]["text"] == "No points: this cell ended before the nodes could be run.\n"
    assert result.verdict == "marked"


def test_an_error_in_another_cell_stops_nothing(marked):
    result = marked(greeting_see="1 / 0")
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert cell(result, "greeting-see")["outputs"][0]["ename"] == "ZeroDivisionError"


def test_an_endless_cell_is_interrupted_and_the_rest_is_marked(marked):
    result = marked(greeting_see="while True: pass", quick="while True: pass")
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert text(result, "greeting-see") == "This cell was interrupted: it took more than 0.5 s.\n"
    assert result.verdict == "marked"


def test_a_process_that_ends_is_started_again_behind_the_cell(marked):
    result = marked(temperature="import os\nprint('bye')\nos._exit(0)")
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 0.0}
    assert result.verdict == "stopped"
    reason = "The notebook `two` stopped in its cell `temperature`. The process ended by itself. "
    assert result.reason == f"{reason}It was started again."
    assert text(result, "temperature") == (
        "bye\nThe notebook stopped here. The process ended by itself. "
        "It was started again after this cell, and the cells below were run.\n"
    )
    shown = text(result, "temperature-points")
    assert shown == "No points: this cell ended before the nodes could be run.\n"


@pytest.mark.parametrize("end", ["os._exit(0)", "os.abort()"])
def test_what_ends_or_hangs_in_one_exercise_takes_nothing_from_the_next(marked, end):
    result = marked(greeting=f"import os\n{end}")
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    assert result.verdict == "stopped"


USES_UP = {"memory": "kept.append(bytes(100_000_000))", "open files": "kept.append(open('/dev/null'))"}


@pytest.mark.parametrize("what", USES_UP)
def test_what_one_exercise_has_used_up_is_there_for_the_next(marked, what):
    use_up = f"\n    def use_up(self):\n        while True:\n            {USES_UP[what]}\n"
    greedy = GREETER.replace('lambda: self.publisher.publish(String(data="Hello!"))', "self.use_up")
    result = marked(greeting=f"kept = []\n{greedy}{use_up}")
    assert points(result)["temperature-points"] == 15
    words = f"Your program had used up the {what}: the notebook was started again after this cell.\n"
    assert text(result, "greeting-points").endswith(words)
    assert result.flags == [
        f"The test cell `greeting-points`: its nodes used up the {what}, so the notebook was started again."
    ]


GREEDY = {
    "memory": "while True:\n    kept.append(bytes(100_000_000))\n",
    "threads": "while True:\n    threading.Thread(target=threading.Event().wait, daemon=True).start()\n",
}


@pytest.mark.parametrize("what", GREEDY)
def test_what_answer_cells_have_used_up_is_there_for_the_next_exercise(marked, what):
    again = f"import threading\nkept = []\n{GREEDY[what]}"
    result = marked(greeting=f"import threading\nkept = []\n{GREETER}\n{GREEDY[what]}", greeting_see=again)
    assert points(result)["temperature-points"] == 15
    words = f"Your program had used up the {what}: the notebook was started again after this cell.\n"
    assert text(result, "greeting-points").endswith(words)
    flag = f"the cells before it used up the {what}, so the notebook was started again."
    assert f"The test cell `greeting-points`: {flag}" in result.flags


def test_a_process_that_ends_within_a_test_keeps_what_was_earned_before(marked):
    dying = RIGHT["temperature"].replace("random.uniform(20.0, 25.0)", "ctypes.string_at(0)")
    dying = f"import ctypes\n{dying}"
    result = marked(temperature=dying)
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 0.0}
    assert result.reason == (
        "The notebook `two` stopped in its cell `temperature-points`. "
        "The process crashed: Segmentation fault."
    )


def test_nodes_that_take_too_long_are_named_and_keep_what_was_earned_before(marked):
    slow = RIGHT["temperature"].replace("random.uniform(20.0, 25.0)", "float(sum(range(10**10)))")
    result = marked(temperature=slow, quick="topics.temperature.grade")
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 0.0}
    assert result.reason == (
        "The notebook `two` stopped in its cell `temperature-points`. Its nodes took more than 0.5 s."
    )


def test_a_cell_that_says_quit_costs_the_next_one(marked):
    result = marked(greeting_see="quit()")
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    assert result.reason.startswith("The notebook `two` stopped in its cell `greeting-points`.")


TRICK = """
import grader.exercise
honest = grader.exercise.Exercise.grade
def grade(self, *nodes):
    {body}
grader.exercise.Exercise.grade = grade
"""


@pytest.mark.parametrize(
    ("body", "flags"),
    [
        ("return 8.0", []),
        ("print('8.0')", []),
        (
            "return honest(topics.temperature, *nodes)",
            ["passed its nodes to the exercise 'temperature' instead of 'greeting'"],
        ),
    ],
)
def test_who_replaces_grade_earns_nothing(marked, body, flags):
    result = marked(greeting_see=TRICK.format(body=body))
    assert points(result)["greeting-points"] == 0
    found = [f"The test cell `greeting-points`: {flag}." for flag in flags]
    assert [flag for flag in result.flags if flag in found] == found


def test_who_grades_twice_in_a_cell_is_judged_by_the_first_time(marked):
    bad = "type('Bad', (Node,), {'__init__': lambda self: Node.__init__(self, 'bad')})"
    result = marked(greeting_see=TRICK.format(body=f"honest(self, {bad})\n    return honest(self, *nodes)"))
    assert points(result)["greeting-points"] < 8
    assert result.flags[-2] == (
        "The test cell `greeting-points`: graded more than once in one cell; only the first time counts."
    )


def test_who_hands_over_nodes_without_end_is_flagged_a_few_times(marked):
    body = "[honest(topics.temperature if n % 2 else self, *nodes) for n in range(1000)]"
    result = marked(greeting_see=TRICK.format(body=body))
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert len(result.flags) < 10


def test_a_thread_that_is_left_over_costs_nothing_and_is_flagged(marked):
    thread = "import threading\ndef haunt():\n    while True: print('boo' * 1000)\n"
    result = marked(greeting_see=f"{thread}threading.Thread(target=haunt, daemon=True).start()")
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert result.verdict == "marked"
    assert result.flags == ["A thread of the notebook `two` was still running after its last cell."]


def test_a_check_that_breaks_gives_no_points_and_is_flagged(marked, monkeypatch):
    @check(points=8)
    def greets(recording):
        """The node greets."""
        raise IndexError("list index out of range")

    broken = replace(topics.greeting, checks=[greets])
    monkeypatch.setattr("grader.exercises.topics.greeting", broken)
    result = marked()
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    [first, second] = result.notebooks[0].cells
    assert (first.needs_look, second.needs_look) == (True, False)
    assert result.flags == [
        "The test cell `greeting-points`: the check 'greets' broke: IndexError: list index out of range."
    ]
    shown = cell(result, "greeting-points")["outputs"][-1]["data"]["text/html"]
    assert "Your instructor decides on its points." in shown
    assert "IndexError" not in shown


def test_a_judge_that_breaks_gives_no_points_and_is_flagged(marked, monkeypatch):
    def judge(self, source, secret):
        raise IndexError("list index out of range")

    monkeypatch.setattr(Exercise, "judge", judge)
    result = marked()
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 0.0}
    assert all(cell.needs_look for cell in result.notebooks[0].cells)
    assert result.verdict == "broken"
    assert result.reason == "a bug in the course: IndexError: list index out of range"
    assert result.flags[0] == (
        "The test cell `greeting-points`: could not be graded, because of a bug in the course: "
        "IndexError: list index out of range."
    )
    assert text(result, "greeting-points") == (
        "This cell could not be graded, because of a bug in the course. Your instructor will look at it.\n"
    )


def test_points_are_converted_where_the_notebook_gives_others_than_the_exercise(marked, monkeypatch):
    worth_more = replace(topics.greeting, checks=[*topics.greeting.checks, *topics.remapping.checks])
    monkeypatch.setattr("grader.exercises.topics.greeting", worth_more)
    result = marked()
    [first, _] = result.notebooks[0].cells
    earned = sum(verdict["earned"] for verdict in first.verdicts)
    assert 0 < earned < 20
    assert first.points == pytest.approx(earned * 8 / 20, abs=0.01)
    assert (first.max, first.needs_look) == (8.0, False)
    assert result.flags == []
    converted = f"{earned:g} of 20 are {first.points:g} of 8 points here.\n"
    assert text(result, "greeting-points").startswith(converted)


def test_what_cant_be_read_is_refused(tmp_path, start_student, monkeypatch):
    hand_in(tmp_path / "ann", release(tmp_path / "02_two"))
    (tmp_path / "ann" / "two.ipynb").write_text("This is no notebook.")
    result = mark_submission(task(tmp_path / "ann", tmp_path / "02_two"), "", start_student)
    assert (result.verdict, result.notebooks) == ("refused", [])
    assert "`two.ipynb`" in result.reason


def test_an_assignment_with_other_tests_is_refused(tmp_path, start_student, monkeypatch):
    released = release(tmp_path / "02_two")
    notebook = nbformat.read(released / "two.ipynb", 4)
    notebook.cells[3].source = "points = topics.greeting.grade(Greeter)"
    nbformat.write(notebook, released / "two.ipynb")
    with pytest.raises(UnknownTest, match=r"^The test cell `greeting-points` can't be marked here"):
        mark_submission(hand_in(tmp_path / "ann", released), "", start_student)


def test_what_only_a_trick_needs_is_flagged_where_it_stands(marked):
    result = marked(greeting_see="import os, gc\nrun(Greeter, seconds=1)")
    assert result.flags == [
        "The cell `greeting-see` imports `gc`, which finds objects that it was not given."
    ]
    assert result.points == 23


def test_half_characters_of_a_student_reach_no_output(marked):
    result = marked(greeting_see="print(chr(0xd83d))")
    assert text(result, "greeting-see") == "?\n"
    result.to_json().encode()


def test_of_very_many_tricks_the_first_are_reported(marked):
    result = marked(greeting="".join(f"import grader.a{number}\n" for number in range(30)))
    assert len(result.flags) == 21
    assert result.flags[0].startswith("The cell `greeting` imports `grader.a0`, which")
    assert result.flags[-1] == "There are 10 more such things in it."


def test_what_is_written_in_private_worlds_is_for_the_instructor(marked):
    writing = "import os\n" + GREETER.replace("lambda: ", "lambda: os.write(1, b'psst ') and ")
    public, private = (marked(secret, greeting=writing, greeting_see="") for secret in ("", "a secret"))
    assert text(public, "greeting-points").startswith("psst psst")
    assert "psst" not in text(private, "greeting-points")
    last = cell(private, "greeting-points")["outputs"][-1]
    assert last["metadata"] == {"for_instructor": True}
    opening = "Written in private worlds; not on the student's page:\npsst psst"
    assert last["data"]["text/plain"].startswith(opening)


# -- the process lives, and could not serve its nodes ---------------------------------------------------

NO_DESCRIPTORS = """
import os, resource
resource.setrlimit(resource.RLIMIT_NOFILE, (40, 40))
kept = []
try:
    while True:
        kept.append(open(os.devnull))
except OSError:
    pass
"""


def test_a_notebook_without_file_descriptors_goes_on(marked):
    result = marked(greeting=GREETER + NO_DESCRIPTORS)
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    assert [cell.needs_look for cell in result.notebooks[0].cells] == [True, False]
    why = "The nodes could not be run: OSError: Too many open files"
    assert (result.verdict, result.reason) == ("marked", "")
    assert result.flags == [
        f"The test cell `greeting-points`: not graded, and worth a look. {why}.",
        "The test cell `greeting-points`: the cells before it used up the open files, "
        "so the notebook was started again.",
    ]
    assert text(result, "greeting-points") == (
        f"No points: this could not be graded. {why}. Your instructor will look at it.\n"
        "Your program had used up the open files: the notebook was started again after this cell.\n"
    )


FULL_DISK = """
import resource
limit = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (0, limit[1]))
"""


def test_a_notebook_with_a_full_disk_goes_on(marked):
    """The limit of a file's size stands for the disk: it makes writing fail in the same way."""
    freed = f"resource.setrlimit(resource.RLIMIT_FSIZE, limit)\n{RIGHT['temperature']}"
    result = marked(greeting=GREETER + FULL_DISK, temperature=freed)
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    assert (result.verdict, result.reason, result.flags) == ("marked", "", [])


def test_what_our_side_can_t_follow_is_one_flag_and_the_notebook_goes_on(marked, monkeypatch):
    def fails(*_):
        raise RuntimeError("an end that is gone")

    monkeypatch.setattr(LeaderLink, "_message_published", fails)
    monkeypatch.setitem(LeaderLink.HANDLERS, MessagePublished, fails)
    result = marked()
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 0.0}
    assert [cell.needs_look for cell in result.notebooks[0].cells] == [True, True]
    message = "could not be graded, because of a bug in the course: RuntimeError: an end that is gone."
    assert result.flags == [f"The test cell `{name}`: {message}" for name in points(result)]
    assert result.verdict == "broken"
    assert result.reason == "a bug in the course: RuntimeError: an end that is gone"
    assert text(result, "greeting-points") == (
        "This cell could not be graded, because of a bug in the course. Your instructor will look at it.\n"
    )


def test_who_sends_nonsense_loses_that_exercise(marked):
    forging = f"""
from sim.ros.remote.follower_link import FollowerLink
honest = FollowerLink.take_outgoing
FollowerLink.take_outgoing = lambda self: [["dance"]]
{GREETER}"""
    honest = f"FollowerLink.take_outgoing = honest\n{RIGHT['temperature']}"
    result = marked(greeting=forging, temperature=honest, greeting_see="")
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    assert result.flags[-1] == (
        "The test cell `greeting-points`: not graded, and worth a look. "
        "The process with the nodes sent an event of unknown kind."
    )


def test_a_run_that_ends_over_there_before_its_time_is_named(marked):
    leaving = f"""
from sim.ros.remote.serving import FollowerLoop
honest = FollowerLoop._answer
def _answer(self, busy):
    raise KeyboardInterrupt("past the node")
FollowerLoop._answer = _answer
{GREETER}"""
    honest = f"FollowerLoop._answer = honest\n{RIGHT['temperature']}"
    result = marked(greeting=leaving, temperature=honest, greeting_see="")
    assert points(result) == {"greeting-points": 0.0, "temperature-points": 15.0}
    assert result.flags[-1] == (
        "The test cell `greeting-points`: not graded, and worth a look. "
        "The nodes could not be run: KeyboardInterrupt: past the node."
    )


def test_a_side_thread_that_crashes_at_once_is_named_and_costs_nothing_that_went_out(marked):
    crashing = f"""
import threading
{GREETER}
        threading.Thread(target=self.watch).start()

    def watch(self):
        raise ValueError("no one listens")
"""
    result = marked(greeting=crashing)
    assert points(result) == {"greeting-points": 8.0, "temperature-points": 15.0}
    named = result.notebooks[0].cells[0].verdicts[0]
    assert named["saw"] == "ValueError: no one listens (in thread Greeter.watch, line 11, at 0 s)"

"""Every program that a lesson calls wrong is a wrong node, adapted by renaming, or the table says why not."""

import ast
import json

import pytest

from tests.rules.programs import called_wrong, definition_of, likeness, problems
from tests.rules.table import LESSONS, ROOT, Cell, cells_of, read_table, table_of

POOR = """
class Slow(Node):  # please don't
    'It sleeps.'

    def tick(self):
        time.sleep(0.2)
"""
CELLS = {
    "good": Cell("code", "class Good(Node):\n    pass"),
    "fails": Cell("markdown", "**What goes wrong** here?"),
    "forgets": Cell("code", "class Forgetful(Adder):\n    def add(self, request, response):\n"
                            "        response.sum = request.a + request.b\n"),
    "shell": Cell("code", "%%bash\nls"),
    "run": Cell("code", "run(Forgetful)"),
    "why": Cell("markdown", "It returns nothing."),
    "cure": Cell("code", "class Cured(Forgetful):\n    pass"),
    "poor": Cell("code", POOR),
}  # fmt: skip
ROW = """[[rule]]
rule = "A service returns its response."
in.why = "It returns nothing."
check = "services/add: runs"
wrong = ["ForgetsReturn", "ReturnsTheNumber"]
right = ["Adder"]
"""


def definition(source):
    return ast.parse(source).body[0]


@pytest.mark.parametrize("lesson", LESSONS)
def test_each_program_that_is_called_wrong_is_a_wrong_node_or_says_why_not(lesson):
    assert list(problems(table_of(lesson), cells_of(lesson))) == []


def test_what_is_called_wrong_is_found():
    found = {cell: [item.name for item in items] for cell, items in called_wrong(CELLS).items()}
    assert found == {"forgets": ["Forgetful"], "poor": ["Slow"]}


def test_what_follows_a_prediction_and_blocks_in_texts_are_found():
    cells = {
        "guess": Cell("code", 'guess = predict("And now?", a="It waits", b="It fails")'),
        "surprise": Cell("code", "class Sleepy(Lamp):\n    pass"),
        "result": Cell("markdown", "It waits."),
        "other": Cell("code", "class Other(Lamp):\n    pass"),
        "avoid": Cell("markdown", "Avoid this:\n\n```python\nrclpy.spin(node)  # please don't\n```\n"),
        "fine": Cell("markdown", "Write:\n\n```python\ndef main():\n    pass\n```\n"),
    }
    found = {cell: [item.name for item in items] for cell, items in called_wrong(cells).items()}
    assert found == {"surprise": ["Sleepy"], "avoid": ["program"]}


def test_no_assignment_calls_a_program_wrong_that_it_shows():
    texts = {
        f"{path.stem}: {cell['id']}": Cell(cell["cell_type"], "".join(cell["source"]))
        for path in sorted(ROOT.glob("solutions/*/*.ipynb"))
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "markdown"
    }  # fmt: skip
    assert called_wrong(texts) == {}


def test_renaming_keeps_two_programs_alike_and_another_statement_does_not():
    slow = definition(POOR)
    lazy = "class Lazy(Sensor):\n def on_timer(me):\n  "
    assert likeness(slow, definition(lazy + "time.sleep(3.5)")) == 1.0
    assert likeness(slow, definition(lazy + "time.sleep(3.5)\n  me.go()")) < 0.8
    assert likeness(slow, definition(lazy + "return 3.5")) < 0.8
    swapped = "def f(a, b):\n return a - b", "def f(c, d):\n return d - c"
    assert likeness(*map(definition, swapped)) < 1.0


def test_a_node_that_a_function_makes_is_its_part():
    assert definition_of("navigating", "navigate", "ignores_the_frame").name == "IgnoresTheFrame"
    assert definition_of("services", "add", "ForgetsReturn").name == "ForgetsReturn"


@pytest.mark.parametrize(
    ("more", "sentences"),
    [
        ('program.forgets = "ForgetsReturn"\n[no_node]\npoor = "no exercise: none sleeps"', []),
        ('[no_node]\nforgets = "same mistake: services/add: ForgetsReturn"',
         ["poor: it is called wrong, and no row has it"]),
        ('program.forgets = "ReturnsTheNumber"\n[no_node]\npoor = "not wrong: it is patient"',
         ["forgets: ReturnsTheNumber is 0.87 like the lesson's program, and not 0.9"]),
        ('program.forgets = "Adder"\n[no_node]\npoor = "not wrong: it is patient"',
         ["forgets: Adder is no wrong node of “A service returns its response.”"]),
        ('program.forgets = "ForgetsReturn"\nprogram.cure = "ForgetsReturn"\n[no_node]\npoor = "lazy"',
         ["cure: nothing there is called wrong",
          "poor: “lazy” is none of the reasons same mistake, no exercise, not wrong, with a sentence"]),
        ('program.forgets = "ForgetsReturn"\n[no_node]\npoor = "same mistake: services/add: Adder"',
         ["poor: services/add: Adder is no wrong node"]),
    ],
)  # fmt: skip
def test_a_program_without_its_node_is_named(more, sentences):
    assert list(problems(read_table(ROW + more), CELLS)) == sentences

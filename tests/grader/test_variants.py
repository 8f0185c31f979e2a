import pytest
from rclpy.node import Node

from grader import Exercise, Missed
from grader.programs import LocalPrograms
from grader.seeds import revealed_seeds, secret_of_student
from grader.variants import Variants, drawn_number, with_phrases

TABLES = {"period": (0.5, 0.25), "often": ("twice", "four times")}, {"word": ("Count", "Step", "Tick")}
TEXTS = "{period:g} s", "{often} a second", "{word}: "


class Beeper(Node):
    word = "Beep"

    def __init__(self):
        super().__init__("beeper")
        self.get_logger().info(self.word)


class Buzzer(Beeper):
    word = "Buzz"


@pytest.fixture
def beeps() -> Exercise:
    """An exercise with two variants: a log line says Beep, or Buzz."""
    variants = Variants({"word": ("Beep", "Buzz")}, texts=("“{word}”",))
    made = Exercise("beeps", "A beep", seconds=1, variants=variants, may_end=True)

    @made.check(1)
    def logs(recording):
        """A node logs a line."""
        if not recording.logs:
            raise Missed("a line", "none")

    @made.check(3, after=logs, guess="Write “Beep”.", hints={"Not “Beep”?": lambda run: True})
    def beeps(recording):
        """The line is “Beep”."""
        if recording.logs[0].text != made.drawn.word:
            raise Missed(f"“{made.drawn.word}”", f"“{recording.logs[0].text}”")

    return made


def test_variants_are_the_rows_of_all_tables_in_every_combination():
    variants = Variants(*TABLES, texts=TEXTS)
    every = [variants.values(number) for number in range(variants.count)]
    assert variants.count == 6
    assert every[0] == {"period": 0.5, "often": "twice", "word": "Count"}
    assert len({tuple(values.items()) for values in every}) == 6
    assert {(values["period"], values["often"]) for values in every} == {(0.5, "twice"), (0.25, "four times")}


def test_a_variant_is_described_by_the_first_column_of_each_table():
    variants = Variants(*TABLES, texts=TEXTS)
    assert variants.describe(0) == "period 0.5, word Count"
    assert variants.describe(5) == "period 0.25, word Tick"


def test_phrases_are_replaced_all_at_once_and_only_where_they_are_whole():
    variants = Variants({"n": (1, 2)}, {"m": (2, 1)}, {"topic": ("/a", "/b")}, texts=("{n} s", "{m} s", "{topic}"))
    phrases = variants.phrases(7)
    assert phrases == {"1 s": "2 s", "2 s": "1 s", "/a": "/b"}
    assert with_phrases("1 s, then 2 s on /a, not 11 s, 0.1 s, 1 sec or /ab", phrases) == (
        "2 s, then 1 s on /b, not 11 s, 0.1 s, 1 sec or /ab"
    )
    assert with_phrases("as it is: 1 s", {}) == "as it is: 1 s"


def test_a_phrase_that_begins_with_a_word_may_follow_a_dot():
    assert with_phrases("self.wait(1, 2), await(1, 2)", {"wait(1, ": "wait(3, "}) == "self.wait(3, 2), await(1, 2)"


def test_the_longer_of_two_phrases_is_replaced():
    variants = Variants({"n": (4, 5)}, texts=("Beats: {n}", "{n}"), elsewhere=("[{n}]",))
    assert with_phrases("Beats: 4 and 4", variants.phrases(1)) == "Beats: 5 and 5"
    assert with_phrases("4 [4]", variants.phrases_elsewhere(1)) == "4 [5]"


@pytest.mark.parametrize("tables, texts, why", [
    (({"a": (1, 2)}, {"a": (3, 4)}), (), "two tables of variants have a column 'a'"),
    (({"a": (1, 2), "b": (3, 4, 5)},), (), "the columns a, b need the same number of rows, at least two"),
    (({"a": (1,)},), (), "the columns a need the same number of rows, at least two"),
    (({"a": (1, 2), "b": (1, 3)},), ("{a} s", "{b} s"), "two phrases of variants are '1 s' in the first one"),
])  # fmt: skip
def test_tables_that_can_t_work_are_refused(tables, texts, why):
    with pytest.raises(ValueError) as refused:
        Variants(*tables, texts=texts)
    assert str(refused.value) == why


@pytest.mark.parametrize("number", [-1, 2])
def test_a_number_that_no_variant_has_is_refused(beeps, number):
    with pytest.raises(ValueError) as refused:
        beeps.variant(number)
    assert str(refused.value) == f"there are 2 variants, 0 to 1, and no {number}"


def test_an_exercise_without_variants_says_so():
    plain = Exercise("plain", "A plain one")
    for ask in (lambda: plain.variant(0), lambda: plain.drawn):
        with pytest.raises(ValueError) as refused:
            ask()
        assert str(refused.value) == "exercise plain has no variants"


def test_a_variant_has_its_own_sentences_and_guesses_and_hints(beeps):
    other = beeps.variant(1)
    assert [item.sentence for item in other.checks] == ["A node logs a line.", "The line is “Buzz”."]
    assert (other.checks[1].guess, [*other.checks[1].hints]) == ("Write “Buzz”.", ["Not “Buzz”?"])
    assert other.checks[1].after == (other.checks[0],)
    assert [item.sentence for item in beeps.checks] == ["A node logs a line.", "The line is “Beep”."]


def test_the_first_variant_is_the_course_s_own(beeps):
    same = beeps.variant(0)
    assert [vars(item) for item in same.checks] == [vars(item) for item in beeps.checks]
    assert same.drawn == beeps.drawn


def test_each_variant_judges_by_its_own_values(beeps):
    other = beeps.variant(1)
    assert [float(one.grade(node)) for one in (beeps, other) for node in (Beeper, Buzzer)] == [4, 1, 1, 4]
    verdict = other.judge(LocalPrograms((Beeper,))).verdicts[-1]
    assert (verdict.sentence, verdict.expected, verdict.saw) == ("The line is “Buzz”.", "“Buzz”", "“Beep”")
    assert verdict.hint == "Not “Buzz”?"
    assert beeps.drawn.word == "Beep"


def test_values_hold_while_a_variant_is_in_use(beeps):
    assert beeps.variant(1).drawn.word == "Buzz"
    with beeps.variant(1).in_use():
        assert beeps.drawn.word == "Buzz"
    assert beeps.drawn.word == "Beep"


def test_a_variant_follows_from_secret_and_student_and_exercise():
    every = {
        (secret, student, name): drawn_number(secret_of_student(secret, student), name, 1000)
        for secret in ("d1ce", "other") for student in ("ann", "bob") for name in ("counter", "heart")
    }  # fmt: skip
    assert every["d1ce", "ann", "counter"] == drawn_number(secret_of_student("d1ce", "ann"), "counter", 1000)
    assert len(set(every.values())) == len(every)


def test_every_variant_is_drawn_about_as_often():
    drawn = [drawn_number(secret_of_student("d1ce", f"student {n}"), "counter", 9) for n in range(900)]
    assert all(70 < drawn.count(number) < 130 for number in range(9))


def test_a_revealed_secret_has_the_number_itself():
    own = secret_of_student(revealed_seeds({"counter": [3], "variant of counter": [7]}), "ann")
    assert drawn_number(own, "counter", 9) == 7

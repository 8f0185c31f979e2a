"""Every rule that a lesson states is looked for by a check that exists, or says why it isn't."""

import re

import pytest

from tests.rules import page as rules_page
from tests.rules.statements import statements, without_row
from tests.rules.table import (
    LESSONS,
    ROOT,
    TABLES,
    Cell,
    cells_of,
    problems,
    read_table,
    source_of,
    table_of,
    users,
)

CELLS = {
    "title": Cell("markdown", "# Lesson\n\nYou must read it."),
    "goal": Cell("code", "run()  # please don't"),
    "beat": Cell("markdown", "### What goes wrong: slow\n\nIt beats,\nslowly. Never let it sleep. Do so."),
    "list": Cell("markdown", "Two things:\n\n- always beat;\n- report.\n\n```\nnever\n```\n\n| a | don't |"),
    "check": Cell("markdown", "1. Never?\n\n<details><summary>A</summary>\n\n1. No.\n2. Yes.\n</details>"),
    "summary": Cell("markdown", "## Summary\n\n- A heart\n  always beats.\n- It reports.\n\nNext: never."),
}


def row(**changes: str) -> str:
    """A right row, as TOML, with some keys changed; a key that is "" is left out."""
    values = {"rule": '"A heart beats."', "in.beat": '"It beats, slowly."', "check": '"nodes/heart: beats"'}
    values |= {"wrong": '"PeriodsSwapped"', "right": '["Heart"]'} | changes
    return "[[rule]]\n" + "\n".join(f"{key} = {value}" for key, value in values.items() if value)


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_lesson_has_a_table(lesson):
    assert (TABLES / f"{lesson}.toml").exists()


@pytest.mark.parametrize("lesson", LESSONS)
def test_each_row_holds(lesson):
    assert list(problems(table_of(lesson), cells_of(lesson))) == []


@pytest.mark.parametrize("lesson", LESSONS)
def test_each_statement_of_a_lesson_has_a_row(lesson):
    assert without_row(table_of(lesson), cells_of(lesson)) == []


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_table_states_no_rule_twice(lesson):
    rules = [rule.rule for rule in table_of(lesson).rules]
    assert sorted(rules) == sorted(set(rules))


def test_the_page_is_what_the_tables_give():
    assert rules_page.PAGE.read_text("utf-8") == rules_page.render(), "run python -m tests.rules.page"


def test_students_get_neither_tables_nor_page():
    from grader.course_files.work_folder import student_files
    from grader.marking.release.handout import contents

    given = {*contents(ROOT), *(path.relative_to(ROOT).as_posix() for path in student_files(ROOT))}
    assert not [name for name in given if re.search(r"(^|/)rules/|RULES\.md", name)]


def test_what_must_have_a_row_is_found():
    assert list(statements(CELLS)) == [
        ("goal", ""),
        ("beat", ""),
        ("beat", "Never let it sleep."),
        ("list", "- always beat;"),
        ("list", "| a | don't |"),
        ("check", "1. No."),
        ("check", "2. Yes."),
        ("summary", "- A heart always beats."),
        ("summary", "- It reports."),
    ]


def test_a_quote_is_a_row_for_its_sentence_alone():
    quotes = {"in.list": '"always beat"', "in.summary": '"A heart always beats."', "in.check": '"2. Yes."'}
    no_rule = '\n[no_rule]\nbeat = "Never let it sleep."\nlist = "don\'t"\nsummary = "It reports."'
    missing = ["goal: says what goes wrong", "check: 1. No.", "summary: - It reports."]
    assert without_row(read_table(row(**quotes) + no_rule), CELLS) == missing


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({}, ""),
        ({"in.beet": '"It beats"'}, "“It beats”: the lesson has no cell beet"),
        ({"in.driving.beat": '"fast"'}, "“fast”: the lesson has no cell driving.beat"),
        ({"in.beat": '["It beats,", "fast"]'}, "“fast”: the cell beat doesn't say so"),
        ({"check": ""}, "Expected a check such as “nodes/heart: beats”, or `unchecked`, saw “”"),
        ({"check": '"heart"'}, "Expected a check such as “nodes/heart: beats”, or `unchecked`, saw “heart”"),
        ({"check": '"nodes/heart: sleeps"'}, "There is no check nodes/heart: sleeps"),
        ({"check": '"nodes/lung: beats"'}, "There is no check nodes/lung: beats"),
        ({"check": '"bones/heart: beats"'}, "There is no check bones/heart: beats"),
        ({"wrong": ""}, "It has no wrong node"),
        ({"right": "[]"}, "It has no right node"),
        ({"wrong": '"Sleepy"'}, "The page nodes/heart has no Sleepy"),
        ({"right": '["Heart", "Strong"]'}, "The page nodes/heart has no Strong"),
        ({"wrong": '"OneTimer"'}, "OneTimer loses nothing at ““Beat” is logged every 0.25 s.”"),
        ({"right": '["OneTimer"]'}, "OneTimer doesn't earn everything"),
        ({"technique": "'create_timer'"}, ""),
        ({"technique": "'create_rate'"}, "The source of Heart has nothing like “create_rate”"),
        ({"check": '"nodes/heart: runs"', "wrong": '"SlashInTheName"'}, ""),
        ({"unchecked": '"fact"', "check": ""}, "It has a check or nodes, and says that it is unchecked"),
    ],
)
def test_a_row_that_does_not_hold_says_why(changes, sentence):
    table = read_table(row(**changes))
    about = "" if sentence.startswith("“") else "A heart beats. "
    assert list(problems(table, CELLS)) == ([about + sentence] if sentence else [])


@pytest.mark.parametrize(
    ("unchecked", "sentence"),
    [
        ("fact", ""),
        ("judgment: no run shows it", ""),
        ("judgment", "Why is it “judgment”? Write a reason behind a colon"),
        (
            "lazy: no time",
            "“lazy” is none of the reasons: fact, notebook, judgment, elsewhere, no exercise, not yet",
        ),
    ],
)
def test_a_rule_without_a_check_says_why(unchecked, sentence):
    table = read_table(row(check="", wrong="", right="", unchecked=f'"{unchecked}"'))
    assert list(problems(table, CELLS)) == ([f"A heart beats. {sentence}"] if sentence else [])


def test_a_technique_of_an_unchecked_rule_is_used_by_a_right_node_of_any_exercise():
    assert "silence/lidar: Counter" in users("qos_profile_sensor_data")
    keys = {"check": "", "wrong": "", "right": "", "unchecked": '"fact"'}
    assert list(problems(read_table(row(**keys, technique="'qos_profile_sensor_data'")), CELLS)) == []
    sentence = "A heart beats. No right node of any exercise has anything like “create_heart”"
    assert list(problems(read_table(row(**keys, technique="'create_heart'")), CELLS)) == [sentence]


def test_a_key_that_rows_do_not_have_is_an_error():
    with pytest.raises(TypeError, match="unexpected keyword argument 'rihgt'"):
        read_table(row(rihgt='"Heart"'))


def test_the_source_of_a_node_has_all_that_it_uses():
    assert "class Heart(Node)" in source_of("nodes", "heart", "main_with_arguments")
    assert "LoopsInInit" not in source_of("nodes", "heart", "main_with_arguments")
    assert "return Process(OneMeter" in source_of("topics", "remapping", "as_task_says")
    assert "DurabilityPolicy.TRANSIENT_LOCAL" in source_of("silence", "late", "main_without_a_class")
    assert "heapq.heappush" in source_of("navigator", "plan", "Planner")
    assert "namespace=side" in source_of("launching", "convoy", "Convoy")

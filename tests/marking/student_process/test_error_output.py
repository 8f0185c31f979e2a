import linecache

from grader.marking.student_process.error_output import error_output


def reported(source: str) -> list[str]:
    """What is reported of the error that a cell of this source raises."""
    linecache.cache["cell"] = (len(source), None, source.splitlines(keepends=True), "cell")
    try:
        exec(compile(source, "cell", "exec"), {})
    except BaseException as error:
        return error_output(error, {"cell": 7})["traceback"]
    raise AssertionError("the cell raised nothing")


def test_an_error_shows_the_students_own_lines():
    assert reported("def go():\n    return 1 / 0\n\ngo()") == [
        "In [7], line 4:",
        "    go()",
        "In [7], line 2, in go:",
        "    return 1 / 0",
        "ZeroDivisionError: division by zero",
    ]


def test_frames_of_libraries_are_left_out():
    assert reported("import json\njson.loads('{')") == [
        "In [7], line 2:",
        "    json.loads('{')",
        "json.decoder.JSONDecodeError: Expecting property name enclosed in double quotes: "
        "line 1 column 2 (char 1)",
    ]


def test_an_error_that_led_to_another_comes_first():
    source = "try:\n    1 / 0\nexcept ZeroDivisionError:\n    raise ValueError('x')"
    assert reported(source) == [
        "In [7], line 2:",
        "    1 / 0",
        "ZeroDivisionError: division by zero",
        "The next error was caused by this one, or came while handling it:",
        "In [7], line 4:",
        "    raise ValueError('x')",
        "ValueError: x",
    ]


def test_an_error_from_none_comes_alone():
    source = "try:\n    1 / 0\nexcept ZeroDivisionError:\n    raise ValueError('x') from None"
    assert reported(source) == ["In [7], line 4:", "    raise ValueError('x') from None", "ValueError: x"]


def test_code_that_cant_be_read_is_shown_with_a_mark():
    assert reported("x = = 2") == [
        '  File "In [7]", line 1',
        "    x = = 2",
        "        ^",
        "SyntaxError: invalid syntax",
    ]


def test_a_recursion_without_end_is_reported_by_its_last_lines():
    lines = reported("def go():\n    go()\ngo()")
    assert lines[0].startswith("... ") and lines[0].endswith(" more lines")
    assert lines[1:-1] == ["In [7], line 2, in go:", "    go()"] * 8
    assert lines[-1].startswith("RecursionError: maximum recursion depth exceeded")


def test_an_error_that_cant_even_be_read_is_reported():
    source = "class E(Exception):\n    def __str__(self):\n        raise KeyError\nraise E"
    error = reported(source)
    assert error[-1] == "E: <exception str() failed>"


def test_a_long_message_is_cut():
    assert len(reported("raise ValueError('x' * 10**6)")[-1]) == 4000

import pytest
from std_msgs.msg import String

from grader import Missed
from grader.checks import answers, logs
from tests.grader.recordings import logged, published, recording


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def test_logs_finds_lines_whatever_their_capital_letters():
    found = logs(logged((1.0, "INFO", "Count: 1"), (2.0, "INFO", "count: 2")), r"count: \d")
    assert [line.stamp for line in found] == [1.0, 2.0]


def test_logs_misses_silence():
    miss = missed(logs, recording(), "count", level="WARN")
    assert (miss.expected, miss.saw) == ("a log line at level WARN like “count”", "no log line at all")


def test_logs_misses_other_lines():
    miss = missed(logs, logged((1.0, "INFO", "hello")), "count")
    assert (miss.saw, miss.hint) == ("no such line; the first line is “hello”", "")


def test_logs_shows_the_most_similar_line():
    run = logged((1.0, "INFO", "hello"), (2.0, "INFO", "COUNT = 1"), (3.0, "INFO", "COUNT = 2"))
    miss = missed(logs, run, r"^count: \d+$", example="Count: 1")
    assert miss.expected == "a log line like “Count: 1”"
    assert (miss.saw, miss.hint) == ("“COUNT = 1”", "Compare the two texts letter by letter.")


def test_logs_sees_that_an_f_is_missing():
    miss = missed(logs, logged((1.0, "INFO", "count: {self.count}")), r"count: \d")
    assert miss.saw == "“count: {self.count}”"
    assert miss.hint == 'Put an f before the quotes: f"..." fills in what stands in braces.'


@pytest.mark.parametrize(
    "level, method",
    [("WARN", "warning"), ("ERROR", "error"), ("FATAL", "fatal"), ("DEBUG", "debug")],
)
def test_logs_misses_another_level_and_names_the_method(level, method):
    miss = missed(logs, logged((1.0, "INFO", "unknown command")), "unknown", level=level)
    assert miss.saw == "“unknown command” at level INFO"
    assert miss.hint == f"Use self.get_logger().{method}(...)."


def test_logs_tells_printing_from_logging():
    miss = missed(logs, recording(prints=[(1.0, "count: 1\n")]), "count")
    assert miss.saw == "“count: 1”, printed"
    assert miss.hint == "Use self.get_logger().info(...) in place of print(...)."


def test_logs_counts():
    miss = missed(logs, logged((1.0, "INFO", "count 1"), (2.0, "INFO", "count 2")), "count", at_least=3)
    assert (miss.expected, miss.saw) == ("3 log lines like “count”", "2; the last at 2 s")


def conversation(*lines):
    run = published("/command", [(1.0, String(data="stand")), (2.0, String(data="walk"))])
    run.logs = logged(*lines).logs
    return run


def said(heard):
    return heard.message.data


def test_answers_is_content_with_a_line_after_each_message():
    answers(conversation((1.0, "INFO", "stand!"), (2.1, "INFO", "walk!")), "/command", said, level="INFO")


def test_answers_gives_credit_for_the_part_that_is_answered():
    miss = missed(answers, conversation((1.0, "INFO", "stand!"), (2.1, "INFO", "stand!")), "/command", said)
    assert miss.expected == "a log line like “walk” after each message on /command"
    assert miss.saw == "“stand!” (INFO) within 0.5 s of the message at 2 s"
    assert miss.credit == 0.5


def test_answers_wants_the_level_and_the_time():
    late = conversation((1.0, "INFO", "stand"), (2.6, "INFO", "walk"))
    miss = missed(answers, late, "/command", said, level="INFO")
    assert miss.expected == "a log line at level INFO like “walk” after each message on /command"
    assert miss.saw == "no line within 0.5 s of the message at 2 s"
    assert missed(answers, late, "/command", "stand|walk", level="WARN", within=1.0).credit == 0.0


def test_answers_asks_only_for_the_messages_that_are_picked():
    one = conversation((1.0, "INFO", "stand!"))
    answers(one, "/command", said, where=lambda heard: said(heard) == "stand")
    with pytest.raises(ValueError, match=r"^nothing was sent on /command, so there is nothing to answer$"):
        answers(one, "/command", said, where=lambda heard: said(heard) == "dance")


def test_answers_needs_messages_to_answer():
    with pytest.raises(ValueError, match=r"^nothing was sent on /command, so there is nothing to answer$"):
        answers(recording(), "/command", "stand")

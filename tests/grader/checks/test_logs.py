import itertools

import pytest
from std_msgs.msg import Float32, String

from grader import Missed
from grader.checks import answers, come_every, logs
from sim.evidence import CallbackRun, Graph, TimerInfo
from tests.sim.recordings import logged, published, recording


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def test_logs_finds_lines_whatever_their_capital_letters():
    found = logs(logged((1.0, "INFO", "Count: 1"), (2.0, "INFO", "count: 2")), r"count: \d")
    assert [line.stamp for line in found] == [1.0, 2.0]


def test_logs_gives_the_texts_of_a_patterns_groups():
    found = logs(logged((1.0, "INFO", "12 C = 53.6 F")), r"(\d+) C = (\S+) F")
    assert [(line.text, line.groups) for line in found] == [("12 C = 53.6 F", ("12", "53.6"))]


def test_logs_misses_silence():
    miss = missed(logs, recording(), "count", level="WARN")
    assert (miss.expected, miss.saw) == ("a log line at level WARN like “count”", "no log line at all")
    assert (miss.hint, miss.guess) == ("", "")


def test_logs_misses_other_lines():
    miss = missed(logs, logged((1.0, "INFO", "hello")), "count")
    assert (miss.saw, miss.hint) == ("no such line; the first line is “hello”", "")
    assert miss.guess == "Compare the two lines. And is the method that should log it ever called?"


def test_logs_shows_the_most_similar_line():
    run = logged((1.0, "INFO", "hello"), (2.0, "INFO", "COUNT = 1"), (3.0, "INFO", "COUNT = 2"))
    miss = missed(logs, run, r"^count: \d+$", example="Count: 1")
    assert miss.expected == "a log line like “Count: 1”"
    assert (miss.saw, miss.hint) == ("“COUNT = 1”", "Compare the two texts letter by letter.")


def test_logs_sees_that_an_f_is_missing():
    miss = missed(logs, logged((1.0, "INFO", "count: {self.count}")), r"count: \d")
    assert miss.saw == "“count: {self.count}”"
    assert miss.hint == 'Put an f before the quotes: f"..." inserts what is in braces.'


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
    assert miss.hint == "Use self.get_logger().info(...) instead of print(...)."


def from_course(run, *indices):
    """The run, with these log lines by a program of the course."""
    for index in indices:
        run.logs[index] = run.logs[index]._replace(node="robot", from_course=True)
    return run


def test_logs_leaves_out_what_the_course_logs():
    run = from_course(logged((1.0, "INFO", "count 1"), (2.0, "INFO", "count 2")), 0)
    assert [line.stamp for line in logs(run, "count")] == [2.0]


def test_logs_shows_the_first_of_several_lines():
    run = logged((1.0, "INFO", "count 1"), (2.0, "DEBUG", "count 2"))
    assert missed(logs, run, "count", level="WARN").saw == "“count 1” at level INFO"
    run = logged((1.0, "INFO", "one"), (2.0, "INFO", "two"))
    assert missed(logs, run, "count").saw == "no such line; the first line is “one”"
    run = logged((1.0, "INFO", "Count: 1"), (2.0, "INFO", "count: 1"), (3.0, "INFO", "other"))
    assert missed(logs, run, r"^count = \d$", example="count = 1").saw == "“Count: 1”"
    run = logged((1.0, "INFO", "count 1"), (2.0, "INFO", "count 2"), (3.0, "INFO", "count 3"))
    assert missed(logs, run, "count", at_least=4).saw == "3; the last at 3 s"


def test_logs_takes_a_line_for_similar_where_seven_of_ten_letters_are_the_same():
    near, far = logged((1.0, "INFO", "abcdefg---")), logged((1.0, "INFO", "abcdef----"))
    assert missed(logs, near, "abcdefghij").saw == "“abcdefg---”"
    assert missed(logs, far, "abcdefghij").saw == "no such line; the first line is “abcdef----”"


def test_logs_counts():
    miss = missed(logs, logged((1.0, "INFO", "count 1"), (2.0, "INFO", "count 2")), "count", at_least=3)
    assert (miss.expected, miss.saw) == ("3 log lines like “count”", "2; the last at 2 s")


def beats(*stamps, timers=(), callbacks=()):
    """A run of 5 s with a line at each of these times, of a node with timers."""
    run = logged(*((stamp, "INFO", "beat") for stamp in stamps))
    timers = [TimerInfo("/heart", period, "Heart.beat") for period in timers]
    run.seconds, run.ended = 5.0, run.ended._replace(stamp=5.0)
    run.graph, run.callbacks = Graph(["/heart"], timers=timers), list(callbacks)
    return run


def pace(run, period=1.0, **options):
    return missed(come_every, run, logs(run, "beat"), period, **options)


def test_come_every_gives_the_lines_that_come_from_start_to_end():
    run = beats(1.0, 2.05, 3.0, 4.0, timers=[1.0])
    lines = logs(run, "beat")
    assert come_every(run, lines, 1.0) == lines


@pytest.mark.parametrize(("period", "gaps"), [(1.0, (1.09, 0.91)), (0.5, (0.54, 0.46))])
def test_come_every_allows_gaps_that_are_a_tenth_off(period, gaps):
    stamps = [period, *itertools.accumulate(gaps, initial=2 * period)]
    run = beats(*stamps, timers=[period]).during(0.0, stamps[-1] + period)
    assert len(come_every(run, logs(run, "beat"), period)) == 4


@pytest.mark.parametrize(
    ("period", "stamps"),
    [(1.0, (1.0, 2.11, 3.1)), (1.0, (1.0, 1.89, 2.9)), (0.5, (0.5, 1.055, 1.55)), (2.0, (2.0, 4.22))],
)
def test_come_every_misses_a_gap_that_is_more_than_a_tenth_off(period, stamps):
    miss = pace(beats(*stamps, timers=[period]), period)
    assert miss.expected == f"a line every {period:g} s, from start to end"
    assert miss.hint.startswith("Let one timer set the pace")


@pytest.mark.parametrize(
    ("period", "first", "last", "moment"),
    [
        (1.0, 1.5, 3.5, ""),
        (1.0, 1.7, 3.7, "1.7"),
        (1.0, 1.3, 3.3, "3.3"),
        (0.5, 0.75, 4.25, ""),
        (0.5, 0.85, 4.35, "0.85"),
        (0.5, 0.65, 4.15, "4.15"),
    ],
)
def test_come_every_allows_a_start_that_is_late_and_an_end_that_is_early_by_16_tenths_of_a_period(
    period, first, last, moment
):
    run = beats(*(first + n * period for n in range(round((last - first) / period) + 1)), timers=[period])
    if moment:
        assert pace(run, period).hint == f"What changes at {moment} s?"
    else:
        assert come_every(run, logs(run, "beat"), period)


def test_come_every_counts_the_start_and_the_end_of_a_window_of_time():
    run = beats(3.0, 3.5, 4.0, timers=[0.5]).during(2.7, 4.2)
    assert len(come_every(run, logs(run, "beat"), 0.5)) == 3


def test_come_every_wants_a_timer_for_a_right_pace_too_and_gives_the_lines_to_later_checks():
    run = beats(1.0, 2.0, 3.0, 4.0)
    miss = pace(run, credit=0.25)
    assert (miss.expected, miss.saw) == ("a timer that sets the pace", "a line every 1 s, but no timer")
    assert miss.hint == (
        "While a loop in the node sleeps, the node receives and answers nothing: create_timer(1, method) calls a method again and again, and leaves the node free."
    )
    assert (miss.credit, miss.measured) == (0.25, logs(run, "beat"))


def test_come_every_says_the_pace_and_that_one_timer_sets_it():
    miss = pace(beats(0.5, 1.0, 1.5, 2.0, timers=[0.5]))
    assert miss.expected == "a line every 1 s, from start to end"
    assert miss.saw == "a line every 0.5 s, from 0.5 s to 2 s"
    assert miss.hint == (
        "Let one timer set the pace, with its period in seconds. Log one line each time its method is called."
    )


@pytest.mark.parametrize(
    ("stamps", "saw"),
    [
        ((2.0,), "one line, at 2 s"),
        ((0.0, 0.0, 0.0), "3 lines at once, at 0 s"),
        ((1.0, 2.0, 2.5, 4.0), "pauses between 0.5 s and 1.5 s"),
        ((0.0, 0.0, 1.0), "lines that come at the same moment, then a pause of 1 s"),
        ((1.0, 1.0 + 4e-7, 1.0 + 8e-7), "3 lines at once, at 1 s"),
        ((1.0, 1.0005, 1.001), "a line every 0.0005 s, from 1 s to 1 s"),
        ((1.0, 1.5, 2.0 + 5e-7), "a line every 0.5 s, from 1 s to 2 s"),
        ((1.0, 1.5, 2.0005), "pauses between 0.5 s and 0.501 s"),
    ],
)
def test_come_every_tells_lines_without_a_pace_and_asks_for_a_timer(stamps, saw):
    miss = pace(beats(*stamps))
    assert miss.saw == saw
    assert miss.hint == (
        "The node has no timer: create_timer(period, method) calls a method again and again."
    )


def test_come_every_misses_lines_of_which_there_are_none():
    assert missed(come_every, beats(), [], 1.0).saw == "no line"


@pytest.mark.parametrize(("stamps", "moment"), [((2.0, 3.0, 4.0, 5.0), "2"), ((1.0, 2.0, 3.0), "3")])
def test_come_every_names_the_moment_at_which_lines_begin_too_late_or_end_too_early(stamps, moment):
    assert pace(beats(*stamps)).hint == f"What changes at {moment} s?"


def test_come_every_names_a_callback_that_waits():
    waits = [CallbackRun(stamp, 2.0, "/heart", "Heart.beat", "timer") for stamp in (1.0, 3.0)]
    miss = pace(beats(1.0, 3.0, 5.0, timers=[1.0], callbacks=waits))
    assert miss.hint.startswith("The timer of /heart fired 2 times in 5 s; 5 were due.")


def test_come_every_gives_the_lines_to_later_checks_where_they_earn_something_themselves():
    run = beats(0.0)
    miss = pace(run, credit=0.5)
    assert (miss.credit, miss.measured) == (0.5, logs(run, "beat"))


def test_come_every_gives_no_credit_unless_it_is_said():
    assert pace(beats(0.0)).credit == 0.0


@pytest.mark.parametrize(
    ("lines", "begin", "period", "credit"),
    [(50, 0.0, 1.0, 0.5), (51, 0.0, 1.0, 0.0), (100, 0.0, 0.5, 0.5), (101, 0.0, 0.5, 0.0), (21, 3.0, 1.0, 0.0)],
)
def test_come_every_gives_no_credit_for_more_than_ten_times_as_many_lines(lines, begin, period, credit):
    run = beats(*(begin + n / lines for n in range(lines))).during(begin)
    assert pace(run, period, credit=0.5).credit == credit


def conversation(*lines):
    run = published("/command", [(1.0, String(data="stand")), (2.0, String(data="walk"))])
    run.logs = logged(*lines).logs
    return run


def said(received):
    return received.message.data


def test_answers_is_content_with_a_line_after_each_message():
    answers(conversation((1.0, "INFO", "stand!"), (2.1, "INFO", "walk!")), "/command", said, level="INFO")


def test_answers_gives_credit_for_the_part_that_is_answered():
    miss = missed(answers, conversation((1.0, "INFO", "stand!"), (2.1, "INFO", "stand!")), "/command", said)
    assert miss.expected == "a log line like “walk” after each message on /command"
    assert miss.saw == "“stand!” (INFO) within 0.5 s of the message at 2 s"
    assert miss.credit == 0.5


def test_answers_gives_no_credit_for_less_than_half():
    run = published("/command", [(float(n), String(data="go")) for n in range(1, 10)])
    run.logs = logged(*((float(n), "INFO", "go") for n in range(1, 5))).logs
    miss = missed(answers, run, "/command", "go")
    assert (miss.saw, miss.credit) == ("no line within 0.5 s of the message at 5 s", 0.0)


def test_answers_shows_the_first_message_without_an_answer_and_the_first_line_after_it():
    lines = (1.0, "INFO", "one"), (1.1, "DEBUG", "two")
    miss = missed(answers, conversation(*lines), "/command", said)
    assert miss.expected == "a log line like “stand” after each message on /command"
    assert miss.saw == "“one” (INFO) within 0.5 s of the message at 1 s"


def test_answers_may_be_of_the_moment_of_the_message_and_not_of_the_course():
    run = conversation((1.0, "INFO", "stand!"), (2.0, "INFO", "walk!"))
    answers(run, "/command", said)
    assert missed(answers, from_course(run, 1), "/command", said).expected == (
        "a log line like “walk” after each message on /command"
    )


def test_answers_wants_the_level_and_the_time():
    late = conversation((1.0, "INFO", "stand"), (2.6, "INFO", "walk"))
    miss = missed(answers, late, "/command", said, level="INFO")
    assert miss.expected == "a log line at level INFO like “walk” after each message on /command"
    assert miss.saw == "no line within 0.5 s of the message at 2 s"
    assert missed(answers, late, "/command", "stand|walk", level="WARN", within=1.0).credit == 0.0


def test_answers_takes_a_line_after_just_that_time_for_one_of_the_next_message():
    miss = missed(answers, conversation((2.0, "INFO", "stand")), "/command", "stand", within=1.0)
    assert (miss.saw, miss.credit) == ("no line within 1 s of the message at 1 s", 0.5)


def test_answers_asks_only_for_the_messages_that_are_picked():
    one = conversation((1.0, "INFO", "stand!"))
    answers(one, "/command", said, where=lambda received: said(received) == "stand")
    miss = missed(answers, one, "/command", said, where=lambda received: said(received) == "dance")
    assert miss.expected == "messages on /command that want a log line"
    assert miss.saw == "none among the 2 on /command"


def test_answers_misses_what_the_students_node_never_sent():
    miss = missed(answers, recording(), "/command", "stand")
    assert (miss.expected, miss.saw) == ("messages on /command that want a log line", "none")


def warned(*lines, levels=(30.0, 10.0, 40.0)):
    """A run with a level every second from 1 s on, and lines, given as (stamp, level)."""
    run = published("/level", [(1.0 + index, Float32(data=value)) for index, value in enumerate(levels)])
    run.logs = logged(*((stamp, level, "low") for stamp, level in lines)).logs
    return run


LOW = {"level": "WARN", "where": lambda received: said(received) < 20.0, "what": "levels below 20 %", "only": True}


def test_answers_may_be_the_only_ones():
    answers(warned((1.0, "INFO"), (2.1, "WARN"), (3.0, "INFO")), "/level", **LOW)


def test_answers_says_what_wants_an_answer():
    miss = missed(answers, warned(), "/level", **LOW)
    assert miss.expected == "a log line at level WARN after each of the levels below 20 %"
    assert (miss.saw, miss.credit) == ("no line within 0.5 s of the message at 2 s", 0.0)


def test_answers_misses_a_line_after_a_message_that_wants_none():
    miss = missed(answers, warned((2.0, "WARN"), (3.0, "WARN")), "/level", **LOW)
    assert (miss.expected, miss.saw) == ("no other log line at level WARN", "“low” at 3 s")
    assert miss.credit == 0.5


def test_answers_shows_the_first_line_that_should_not_be_there():
    run = warned((1.2, "WARN"), (2.0, "WARN"), (3.0, "WARN"))
    assert missed(answers, run, "/level", **LOW).saw == "“low” at 1.2 s"
    run.logs = [line._replace(text=f"low {n}") for n, line in enumerate(run.logs)]
    assert missed(answers, run, "/level", **LOW).saw == "“low 0” at 1.2 s"


def test_answers_minds_other_lines_only_where_it_is_said():
    answers(warned((2.0, "WARN"), (3.0, "WARN")), "/level", **{**LOW, "only": False})
    answers(conversation((0.5, "INFO", "hello"), (1.0, "INFO", "stand"), (2.0, "INFO", "walk")), "/command", said)


def test_answers_misses_a_line_before_the_first_message():
    assert missed(answers, warned((0.5, "WARN"), (2.0, "WARN")), "/level", **LOW).saw == "“low” at 0.5 s"


def test_answers_leaves_lines_of_the_course_alone_where_they_shall_be_the_only_ones():
    run = warned((2.0, "WARN"), (3.0, "WARN"))
    run.logs[1] = run.logs[1]._replace(node="pilot", from_course=True)
    answers(run, "/level", **LOW)


def test_a_student_who_sends_nothing_that_wants_an_answer_has_missed_it():
    miss = missed(answers, warned(levels=[90.0, 90.0]), "/level", **LOW)
    assert (miss.expected, miss.saw) == ("levels below 20 %", "none among the 2 on /level")

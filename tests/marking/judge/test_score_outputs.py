"""What of a score goes to the instructor alone."""

from grader import Score
from grader.checks.verdicts import SPOOFED_TOPICS, Verdict
from grader.marking.judge.score_outputs import spoofed_topics


def test_a_topic_with_two_owners_is_flagged():
    line = Verdict(
        SPOOFED_TOPICS,
        "",
        0.0,
        "failed",
        0.0,
        "one publisher on /odom: /robot",
        "two, /robot and /square of yours",
    )
    assert spoofed_topics(Score("square", [line, Verdict("drives", "", 2.0, "passed", 1.0)])) == [
        "one publisher on /odom: /robot; there were two, /robot and /square of the student"
    ]

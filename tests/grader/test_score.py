import base64
import json
import math
import os
import random
import re
import sys
import zlib

import pytest
from std_msgs.msg import Float64

from grader import Missed, Score, check
from grader.checks import Verdict, arrives
from grader.checks.verdicts import judge
from grader.page import STATUS_STYLES, format_points
from grader.pictures import missed_moments
from sim import Recording, World, run
from sim.evidence import Endpoint
from sim.view import plot_topics
from tests.sim.recordings import driven, published
from tests.students import misfits


def verdict(points, status="passed", credit=None, **words):
    credit = float(status in ("passed", "broken")) if credit is None else credit
    return Verdict(f"check{points}", f"Check <{points}>.", points, status, credit, **words)


MIXED = [
    verdict(0.0, "failed", expected="no error", saw="KeyError: <count>", hint="Set `self.count` & go on."),
    verdict(3.0),
    verdict(2.0, "failed", 0.5, expected="1 Hz", saw="2 Hz"),
    verdict(1.0, "skipped", hint="Not graded: the error above explains it."),
    verdict(4.0, "broken", hint="Nothing to do.", alarm="Traceback ...\nKeyError: 'x'\n"),
]


def test_a_score_is_the_sum_of_what_was_earned():
    score = Score("talk", MIXED, title="A talker")
    assert isinstance(score, float)
    assert (score, score.max, score.exercise, score.title) == (8.0, 10.0, "talk", "A talker")
    assert [v.name for v in score.broken] == ["check4.0"]


@pytest.mark.parametrize(
    "points, shown",
    [([7.5], "7.5"), ([1.0] * 3, "3"), ([], "0"), ([0.1] * 3, "0.3"), ([1 / 3, 1 / 3], "0.6666")],
)
def test_repr_and_str_are_plain_numbers(points, shown):
    score = Score("talk", [verdict(p) for p in points])
    assert repr(score) == str(score) == f"{score}" == shown


def test_whatever_the_points_the_shown_number_is_between_0_and_the_maximum():
    chance = random.Random(1)
    for _ in range(500):
        points = [chance.choice([1 / 3, 2 / 3, 0.1, 1.7, 1e-5, 12.0]) for _ in range(chance.randrange(9))]
        score = Score("talk", [verdict(p, "failed", chance.choice([0.0, 1 / 3, 0.999, 1.0])) for p in points])
        assert math.isfinite(score)
        assert 0.0 <= float(repr(score)) <= score.max <= sum(points) + 1e-9


UNSAFE_DRIVE = [verdict(6.0), verdict(4.0, "failed", 0.0, saw="a wall", unsafe=True)]


def test_an_unsafe_robot_has_a_part_of_the_points_and_a_note_says_why():
    score = Score("drive", UNSAFE_DRIVE, title="A drive")
    assert (float(score), score.max, score.capped) == (4.0, 10.0, True)
    assert score.text.splitlines()[:2] == [
        "A drive: 4 of 10 points",
        "Safety comes first: without “Check <4.0>” there are at most 40% of the points.",
    ]
    assert "Safety comes first: without “Check &lt;4.0&gt;” there" in score._repr_html_()


def test_a_score_below_the_cap_has_no_note():
    score = Score("drive", [verdict(6.0, "failed", 0.5), UNSAFE_DRIVE[1]])
    assert (float(score), score.capped) == (3.0, False)
    assert "Safety" not in score.text


def test_a_score_at_the_cap_has_no_note():
    score = Score("drive", [verdict(4.0), verdict(6.0, "failed", 0.0, unsafe=True)])
    assert (float(score), score.capped) == (4.0, False)


def test_an_exercise_without_a_title_is_called_by_its_name():
    assert Score("talk", []).title == "talk"


@pytest.mark.parametrize(
    ("points", "credit", "earned"),
    [
        (7.0, 0.327, 2.0),
        (5.0, 0.5, 2.5),
        (3.0, 1 / 3, 1.0),
        (2.0, 0.99, 1.5),
        (1 / 3, 1.0, 1 / 3),
        (1, 0.4, 0),
    ],
)
def test_points_are_whole_and_half_ones_and_never_more_than_were_earned(points, credit, earned):
    assert verdict(points, "failed", credit).earned == earned


def test_full_marks_are_exactly_the_maximum():
    score = Score("talk", [verdict(p) for p in (0.1, 0.2, 0.7, 1 / 3)])
    assert float(repr(score)) == score.max


def test_the_text_for_a_terminal():
    assert (
        Score("talk", MIXED, title="A talker").text
        == """\
A talker: 8 of 10 points
  ✘ missed                 Check <0.0>.
        Expected: no error
        Saw: KeyError: <count>
        Hint: Set `self.count` & go on.
  ✔ passed          3 / 3  Check <3.0>.
  ◐ partly          1 / 2  Check <2.0>.
        Expected: 1 Hz
        Saw: 2 Hz
  ○ skipped         0 / 1  Check <1.0>.
        Note: Not graded: the error above explains it.
  ! our mistake     4 / 4  Check <4.0>.
        Note: Nothing to do.
        For the instructor: KeyError: 'x'"""
    )


def test_a_long_hint_is_wrapped_in_the_text():
    score = Score("talk", [verdict(1.0, "failed", hint="word " * 40)])
    assert max(map(len, score.text.splitlines())) <= 88


def test_several_runs_have_labels():
    recordings = [Recording(), Recording(world=World.load("maze"))]
    in_maze = Verdict("turns", "It turns.", 1.0, "failed", 0.0, "a turn", "none", run=1)
    assert "Run: 2 of 2, world maze\n        Expected: a turn" in Score("drive", [in_maze], recordings).text
    assert "Run: 1 of 2\n" in Score("drive", [verdict(1.0, "failed", saw="none")], recordings).text
    assert "Run:" not in Score("drive", [in_maze], recordings[1:]).text


def test_the_html_has_everything_escaped():
    page = Score("talk", MIXED, title="A <talker>")._repr_html_()
    words = re.sub(r"<[^>]+>", " ", page)
    for reported in (
        "A &lt;talker&gt;: 8 of 10 points",
        "Check &lt;2.0&gt;.",
        "KeyError: &lt;count&gt;",
        "1 / 2",
    ):
        assert reported in words
    assert "<code>self.count</code> &amp; go on." in page
    for symbol, word, *_ in STATUS_STYLES.values():
        assert f"{symbol} {word}" in words


def test_the_html_is_a_table_without_script_class_or_address():
    page = Score("talk", MIXED)._repr_html_()
    assert {tag.lower() for tag in re.findall(r"<(\w+)", page)} <= set(
        ["table", "caption", "thead", "tbody", "tr", "th", "td", "div", "b", "code"]
    )
    assert set(re.findall(r' (\w+)="', page)) == {"style", "scope"}
    assert "http" not in page


def test_equal_scores_have_equal_html():
    assert Score("talk", MIXED)._repr_html_() == Score("talk", MIXED)._repr_html_()


def test_marks_can_be_read_in_light_and_dark_themes():
    def luminance(color):
        parts = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
        return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))

    for _, _, color, background in STATUS_STYLES.values():
        assert (luminance(background) + 0.05) / (luminance(color) + 0.05) >= 7
        assert 1.05 / (luminance(color) + 0.05) >= 7  # where a sanitizer has removed the background


def test_as_dict_is_ready_for_json():
    data = json.loads(json.dumps(Score("talk", MIXED, title="A talker").as_dict()))
    assert (data["exercise"], data["title"], data["points"], data["max"]) == ("talk", "A talker", 8.0, 10.0)
    assert data["verdicts"][2]["earned"] == 1.0
    assert data["verdicts"][2]["saw"] == "2 Hz"


def test_each_kind_of_picture_is_drawn_once():
    path = verdict(1.0, "failed", picture="path")
    topics = verdict(2.0, "failed", picture="topics")
    recording = run(misfits.Talker, world="yard", seconds=1, quiet=True)
    (said, way), (reported, strokes) = Score("drive", [path, path, topics, verdict(3.0)], [recording]).pictures
    assert (said, reported) == ("The robot's path, seen from above", "What was published, and when")
    assert way.html == recording.replay().html
    assert strokes._repr_png_() == plot_topics(recording)._repr_png_()


def test_a_miss_about_numbers_shows_their_curve():
    run = published("/heading", [(1.0, Float64(data=1.0)), (2.0, Float64(data=3.0))], seconds=3.0)
    ((caption, curve),) = Score("gyro", [verdict(1.0, "failed", picture="/heading")], [run]).pictures
    assert caption == "The numbers on /heading"
    assert curve.axes[0].lines[0].get_ydata().tolist() == [1.0, 3.0]


def test_in_jupyter_each_picture_is_displayed_with_its_caption_as_the_text_for_screen_readers(monkeypatch):
    displayed = []
    monkeypatch.setattr("IPython.display.display", lambda item, metadata: displayed.append((item, metadata)))
    recording = run(misfits.Talker, world="yard", seconds=1, quiet=True)
    Score("drive", [verdict(1.0, "failed", picture="path")], [recording])._repr_mimebundle_()
    ((picture, metadata),) = displayed
    assert picture.html == recording.replay().html
    assert metadata == {"image/png": {"alt": "The robot's path, seen from above"}}
    Score("drive", [verdict(1.0)], [recording])._repr_mimebundle_()
    assert len(displayed) == 1


def test_a_picture_that_cannot_be_drawn_costs_nothing(capfd):
    nothing_moved = Recording(world=World.load("yard"))
    score = Score("drive", [verdict(1.0, "failed", picture="path")], [nothing_moved])
    bundle = score._repr_mimebundle_()
    assert bundle == {"text/plain": "0", "text/html": score._repr_html_()}
    said = capfd.readouterr()
    assert said.out == (
        "(A picture could not be drawn: nothing has moved in this run yet: it has no pose to draw)\n"
    )
    assert said.err == ""


def test_the_picture_is_of_the_run_that_missed():
    missed_in_second = Verdict("drives", "It drives.", 1.0, "failed", 0.0, picture="path", run=1)
    near, far = driven([(0, 0), (0.1, 0)]), driven([(0, 0), (2, 0)])
    ((_, shown),) = Score("drive", [missed_in_second], [near, far]).pictures
    ((_, of_far),) = Score("drive", [missed_in_second], [far, far]).pictures
    ((_, of_near),) = Score("drive", [missed_in_second], [far, near]).pictures
    assert shown.html == of_far.html != of_near.html


def test_a_picture_holds_neither_the_seed_nor_a_path_of_the_machine():
    class Raising(misfits.Talker):
        def tick(self):
            raise ValueError("no words")

    seed = 3_141_592_653
    recording = run(Raising, world="room", seconds=1, seed=seed, quiet=True)
    ((_, shown),) = Score("drive", [verdict(1.0, "failed", picture="path")], [recording]).pictures
    packed = re.search(r'data-replay="([^"]+)"', shown.html)[1]
    said = zlib.decompress(base64.b64decode(packed), -15).decode()
    assert '"name":"room"' in said
    assert "ValueError in Raising.tick: no words" in said
    words = re.sub(r"[A-Za-z0-9+/=]{200,}", "", shown.html) + said
    assert [
        secret for secret in (str(seed), os.getcwd(), os.path.dirname(sys.executable)) if secret in words
    ] == []


@pytest.mark.parametrize(
    "points, shown", [(7.0, "7"), (7.5, "7.5"), (2 / 3, "0.67"), (0.0, "0"), (10.0, "10")]
)
def test_numbers_have_no_needless_zeros(points, shown):
    assert format_points(points) == shown


def typo(from_course=False):
    """A run with a typo in a topic's name; from_course: both nodes are the course's."""
    recording = Recording()
    for kind, node, name in (("publisher", "/talker", "/news"), ("subscription", "/paper", "/newz")):
        recording.graph.nodes.append(node)
        recording.graph.endpoints.append(Endpoint(kind, node, name, "std_msgs/msg/String", {}, from_course))
    return recording


def rows(score):
    return re.findall(r"<tr><td.*?</tr>", score._repr_html_(), re.S)


NEWS = {"expected": "messages on /newz", "saw": "none"}


def test_where_a_missing_connection_cost_points_the_graph_of_that_run_is_folded_below():
    missed = verdict(2.0, "failed", run=1, **NEWS)
    score = Score("talk", [verdict(3.0), missed, missed], [Recording(), typo()])
    first, second, third = rows(score)
    assert "<details>" not in first + third  # once is enough
    words, folded = second.split("<details>")
    assert words.endswith("<div><b>Saw:</b> none</div>")
    summary, image = folded.split("</summary>")
    assert summary == "<summary>The graph of this run: what is missing is red"
    picture, alt = re.search(r'<img src="data:image/png;base64,([^"]+)" alt="([^"]+)"', image).groups()
    assert base64.b64decode(picture).startswith(b"\x89PNG")
    assert "1. /paper receives nothing: no node publishes on /newz, but /talker publishes on /news." in alt
    assert "(0 messages): /talker -&gt; no node" in alt
    assert "/newz" in score.text and "graph" not in score.text


@pytest.mark.parametrize(
    "missed",
    [
        verdict(2.0, "failed", expected="messages on /newzpaper/newz", saw="none"),
        verdict(2.0, "failed", expected="2 Hz", saw="1 Hz"),
        verdict(2.0, "skipped", **NEWS),
        verdict(2.0, "failed", run=1, **NEWS),  # of which there is no recording
    ],
)
def test_a_miss_on_something_else_has_no_graph(missed):
    assert "<details>" not in Score("talk", [missed], [typo()])._repr_html_()


def test_a_fault_that_the_exercise_is_about_is_not_shown_nor_a_robot_without_commands():
    recording = typo(from_course=True)
    recording.graph.endpoints.append(
        Endpoint("subscription", "/robot", "/cmd_vel", "Twist", {}, from_course=True)
    )
    missed = verdict(2.0, "failed", expected="messages on /cmd_vel and /newz")
    assert "<details>" not in Score("talk", [missed], [recording])._repr_html_()


def test_a_graph_that_cannot_be_drawn_costs_nothing():
    recording = typo()
    recording.graph.nodes.append(None)
    score = Score("talk", [verdict(2.0, "failed", **NEWS)], [recording])
    assert "<details>" not in score._repr_html_() and "messages on /newz" in score._repr_html_()


def test_a_moment_of_a_missed_check_is_a_link_where_its_run_has_a_replay():
    recording = driven([(0, 0), (1, 0), (2, 0), (3, 0)])
    verdicts = [
        Verdict("a", "It stands.", 1.0, "failed", 0.0, "0 m/s from 1 s", "it moved at 2.5 s", "Look.", "path"),
        Verdict("b", "It is quiet.", 1.0, "failed", 0.0, "nothing at 1.5 s", "a message"),
        Verdict("c", "It turns.", 1.0, "failed", 0.0, "", "it turned at 2.5 s"),
        Verdict("d", "It comes.", 1.0, "passed", 1.0),
    ]
    score = Score("drive", verdicts, [recording])
    html = score._repr_html_()
    key = recording.digest[:12]
    assert f'it moved at <a href="#run-{key}-2.5">2.5 s</a>' in html
    assert f'0 m/s from <a href="#run-{key}-1">1 s</a>' in html
    assert missed_moments(verdicts, 0, recording) == [(1.5, "It is quiet. a message"), (2.5, "It stands. it moved at 2.5 s")]
    ((_, picture),) = score.pictures
    assert picture.html == recording.replay(moments=missed_moments(verdicts, 0, recording)).html


def test_a_miss_without_a_moment_has_the_first_motion_in_the_part_of_the_run_that_was_looked_at():
    @check(points=1)
    def waits(run):
        "The robot stands still until it is called."
        stands(run.during(1.0, 2.5), "until the call")

    @check(points=1)
    def comes(run):
        "It comes to the goal."
        arrives(run, (9.0, 0.0))

    def stands(part, when):
        raise Missed(f"a robot that stands still {when}", "it moved", picture="path")

    recording = driven([(0, 0), (1, 0), (2, 0), (3, 0)])
    verdicts = judge([waits, comes], recording)
    assert [verdict.begin for verdict in verdicts] == [1.0, None]
    assert missed_moments(verdicts, 0, recording) == [(2.0, "The robot stands still until it is called. it moved")]


def test_a_moment_of_a_run_without_a_replay_is_plain_text():
    verdict = Verdict("a", "It stands.", 1.0, "failed", 0.0, "", "it moved at 2.5 s")
    assert "<a " not in Score("drive", [verdict], [driven([(0, 0), (1, 0)])])._repr_html_()

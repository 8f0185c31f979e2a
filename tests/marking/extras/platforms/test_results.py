"""What each platform gets of a report, in the form that the platform documents."""
import copy
import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import jsonschema
import pytest

from grader.marking.errors import CourseError
from grader.marking.extras.platforms import classroom50, gradescope, prairielearn
from grader.marking.extras.platforms.texts import (
    check_html,
    check_text,
    instructor_text,
    overview,
    overview_html,
)

TEXT = {"type": "string"}
NUMBER = {"type": "number", "minimum": 0}
VISIBLE = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
FORMAT = {"enum": ["text", "html", "simple_format", "md", "ansi"]}


def closed(required: list[str], **properties: Any) -> dict[str, Any]:
    """The schema of an object with these properties and no others."""
    return {
        "type": "object", "additionalProperties": False, "required": required, "properties": properties
    }  # fmt: skip


# As https://gradescope-autograders.readthedocs.io/en/latest/specs/ describes results.json.
GRADESCOPE = closed(
    ["score", "tests"],
    score=NUMBER, execution_time=NUMBER, output=TEXT, output_format=FORMAT, visibility=VISIBLE,
    stdout_visibility=VISIBLE, extra_data={"type": "object"},
    tests={"type": "array", "items": closed(
        ["score", "max_score", "name"],
        score=NUMBER, max_score=NUMBER, status={"enum": ["passed", "failed"]}, name=TEXT, number=TEXT,
        output=TEXT, output_format=FORMAT, visibility=VISIBLE,
    )},
    leaderboard={"type": "array", "minItems": 1, "items": closed(
        ["name", "value"], name=TEXT, value={"type": "number"}, order={"enum": ["asc", "desc"]},
    )},
)  # fmt: skip
# As Classroom 50's schemas/result-v1.schema.json describes result.json; other fields are refused there, too.
STAMP = {"type": "string", "minLength": 1}
WHOLE = {"type": "integer", "minimum": 0}
CLASSROOM50 = closed(
    ["schema", "classroom", "assignment", "assignment_type", "owner", "submission", "commit", "release",
     "review", "datetime", "score", "max-score", "tests"],
    **{"schema": {"const": "classroom50/result/v1"}, "classroom": STAMP, "assignment": STAMP,
       "assignment_type": {"enum": ["individual", "group"]}, "owner": STAMP,
       "submission": {"type": "string", "pattern": "^submit/"}, "commit": STAMP, "release": STAMP,
       "review": STAMP, "datetime": {"type": "string", "pattern": r"^\d{4}(-\d\d){2}T\d\d(:\d\d){2}Z$"},
       "score": WHOLE, "max-score": WHOLE,
       "tests": {"type": "array", "items": {
           "type": "object", "required": ["test-name", "passed", "score", "max-score"],
           "properties": {"test-name": STAMP, "passed": {"type": "boolean"}, "score": WHOLE,
                          "max-score": WHOLE},
       }}},
)  # fmt: skip
# As https://prairielearn.readthedocs.io/en/latest/externalGrading/ describes results.json.
PRAIRIELEARN = closed(
    ["gradable"],
    gradable={"type": "boolean"}, score={"type": "number", "minimum": 0, "maximum": 1}, message=TEXT,
    format_errors={"type": "array", "items": TEXT},
    tests={"type": "array", "items": closed(
        ["name", "points", "max_points"], name=TEXT, points=NUMBER, max_points=NUMBER, message=TEXT,
    )},
)  # fmt: skip

RUNNER = {
    "CLASSROOM": "robots", "ASSIGNMENT": "topics", "OWNER": "ann", "USERNAME": "ann",
    "SUBMISSION_TAG": "submit/2026-06-01T14-32-05Z-a1b2c3d", "COMMIT_URL": "https://example.org/commit/1",
    "RELEASE_URL": "https://example.org/release/1",
}  # fmt: skip


def check(name: str, points: float, most: float, **texts: str) -> dict[str, Any]:
    status = "passed" if points == most else "failed"
    words = {"sentence": f"It {name}s.", "expected": "", "saw": "", "hint": "", **texts}
    return {"check": name, "status": status, "points": points, "max_points": most, **words}


@pytest.fixture
def data() -> dict[str, Any]:
    """A report: one exercise right, one half right with an unsafe robot, one that was not run."""
    about = {"notebook": "topics", "needs_look": False, "recordings": [], "unsafe": False}
    wrong = {"expected": "a square", "saw": "a <b>circle</b> | *", "hint": "Turn by 90 degrees."}
    exercises = [
        {"exercise": "greeting", "cell": "a", "points": 8.0, "max_points": 8.0, **about,
         "checks": [check("greet", 5.0, 5.0), check("repeat", 3.0, 3.0)]},
        {"exercise": "square", "cell": "b", "points": 6.5, "max_points": 18.0, **about, "unsafe": True,
         "checks": [check("drive", 10.0, 10.0), check("turn", 2.5, 8.0, **wrong)]},
        {"exercise": "relay", "cell": "c", "points": 0.0, "max_points": 4.0, **about, "checks": []},
    ]  # fmt: skip
    return {
        "form": "ros2-notebook-course/mark-one/1", "student": "ann", "assignment": "02_topics",
        "verdict": "stopped", "reason": "The notebook `topics` stopped.", "points": 14.5, "max_points": 30.0,
        "points_after_lateness": 13.0, "repairs": ["A cell was missing."], "flags": ["It imports `gc`."],
        "late": {"due": "", "handed_in": "", "days": 1.25, "percent_per_day": 10.0, "penalty": 1.5},
        "exercises": exercises, "needs_look": False, "points_by_hand": 0.0, "isolation": "separate user",
        "evidence": {"release": "ab"}, "seconds": 6.6,
    }  # fmt: skip


def test_gradescope_gets_a_test_for_each_check_and_the_total(data):
    found = gradescope.results(data, "after_due_date")
    jsonschema.validate(found, GRADESCOPE)
    assert (found["score"], found["execution_time"]) == (13.0, 7)
    first, _, _, turn = found["tests"]
    assert first == {
        "number": "1.1", "name": "greeting: It greets.", "score": 5.0, "max_score": 5.0, "status": "passed",
        "output": "", "output_format": "html", "visibility": "after_due_date",
    }  # fmt: skip
    assert turn["output"] == (
        "<p><b>Expected:</b> a square</p><p><b>Saw:</b> a &lt;b&gt;circle&lt;/b&gt; | *</p>"
        "<p><b>Hint:</b> Turn by 90 degrees.</p>"
    )
    assert (found["output_format"], turn["output_format"]) == ("html", "html")
    assert found["stdout_visibility"] == "hidden"
    assert "leaderboard" not in found


HOSTILE = (
    "</p><script>alert(1)</script><img src=x onerror=\"alert(1)\"> <a href='javascript:alert(1)'>x</a>",
    "&lt;script&gt; &amp; &#60;b> <!-- ]]> <![CDATA[ <?php <p",
    "first\nsecond\r\n\n<br>third\x00\x1b[31m\u202e\ufffe\ud800",
)


@pytest.mark.parametrize("text", HOSTILE)
def test_nothing_that_a_student_wrote_is_markup_on_gradescope(data, text):
    wrong = data["exercises"][1]["checks"][1]
    wrong |= {"expected": text, "saw": text, "hint": text}
    data |= {"reason": text, "repairs": [text]}
    found = json.loads(json.dumps(gradescope.results(data)))
    jsonschema.validate(found, GRADESCOPE)
    assert (text_of(check_html(wrong)), text_of(overview_html(data))) == (check_text(wrong), overview(data))
    for output in (found["output"], *(test["output"] for test in found["tests"])):
        tree = ElementTree.fromstring(f"<div>{output}</div>")
        assert {part.tag for part in tree.iter()} <= {"div", "p", "b", "br"}
        assert not any(part.attrib for part in tree.iter())


def text_of(output: str) -> str:
    """The text of some HTML, a line for each paragraph and after each line break."""
    paragraphs = ElementTree.fromstring(f"<div>{output}</div>").findall("p")
    for end in (end for paragraph in paragraphs for end in paragraph.iter("br")):
        end.text = "\n"
    return "\n".join("".join(paragraph.itertext()) for paragraph in paragraphs)


def test_no_test_is_hidden_because_students_would_not_see_their_total_then(data):
    for visibility in ("visible", "after_due_date"):
        tests = gradescope.results(data, visibility)["tests"]
        assert {test["visibility"] for test in tests} == {visibility}


def test_what_is_for_the_instructor_is_in_no_result(data):
    assert "imports" not in json.dumps(gradescope.results(data))
    assert "imports" not in json.dumps(prairielearn.results(data))
    assert "imports" not in json.dumps(classroom50.result(data, RUNNER)) + classroom50.release_body(data)
    assert instructor_text(data) == "It imports `gc`.\nIsolation: separate user.\nEvidence: release ab."


def test_control_characters_that_a_student_printed_make_no_colors_and_no_links(data):
    data["reason"] = "It printed \x1b]8;;javascript:alert(1)\x1b\\here."
    data["exercises"][1]["checks"][1]["saw"] = "\x1b[31mred\x1b[0m\u202e\n2"
    assert overview(data).splitlines()[2] == "It printed  ]8;;javascript:alert(1) \\here."
    text = check_text(data["exercises"][1]["checks"][1])
    assert text.splitlines()[1:3] == ["Saw:  [31mred [0m ", "2"]


def test_the_overview_explains_points_that_are_not_the_sum_of_the_checks(data):
    assert overview(data) == (
        "14.5 of 30 points.\n"
        "Handed in 1.2 days late: 1.5 points are lost, 13 remain.\n"
        "The notebook `topics` stopped.\n"
        "square: 6.5 of 18 points, because the robot was unsafe.\n"
        "relay: 0 of 4 points; its nodes could not be run.\n"
        "Repaired first: A cell was missing."
    )
    data |= {"needs_look": True, "points_by_hand": 5.0, "verdict": "refused", "late": None, "repairs": []}
    assert overview(data).splitlines()[1:3] == [
        "Your submission could not be marked.", "The notebook `topics` stopped."
    ]  # fmt: skip
    assert overview(data).splitlines()[-2:] == [
        "Your instructor will look at some of the points.",
        "Your instructor gives up to 5 points more by hand.",
    ]


def test_a_check_that_passed_says_nothing(data):
    assert check_text(data["exercises"][0]["checks"][0]) == ""


def test_classroom50_gets_half_points_as_integers(data):
    found = classroom50.result(data, RUNNER, datetime(2026, 6, 1, 14, 33, 11, tzinfo=UTC))
    jsonschema.validate(found, CLASSROOM50)
    assert (found["score"], found["max-score"]) == (29, 60)
    assert [(test["score"], test["max-score"], test["passed"]) for test in found["tests"]] == [
        (16, 16, True), (13, 36, False), (0, 8, False)
    ]  # fmt: skip
    assert (found["datetime"], found["owner"]) == ("2026-06-01T14:33:11Z", "ann")
    assert found["review"] == RUNNER["COMMIT_URL"]


def test_of_a_refused_submission_classroom50_gets_zero_of_all(data):
    data |= {"exercises": [], "verdict": "refused", "points": 0.0}
    found = classroom50.result(data, RUNNER)
    jsonschema.validate(found, CLASSROOM50)
    assert (found["score"], found["max-score"], found["tests"]) == (0, 60, [])


def test_the_release_text_has_nothing_of_the_students_as_markup(data):
    text = classroom50.release_body(data)
    assert "### 02_topics: 14.5 of 30 points" in text
    assert r"Saw: a \<b\>circle\</b\> \| \*" in text


def test_prairielearn_gets_a_share_of_one(data):
    found = prairielearn.results(data)
    jsonschema.validate(found, PRAIRIELEARN)
    assert found["score"] == pytest.approx(14.5 / 30)
    assert [test["points"] for test in found["tests"]] == [5.0, 3.0, 10.0, 2.5]


def test_for_prairielearn_a_refused_submission_is_not_gradable(data):
    found = prairielearn.results(data | {"verdict": "refused", "reason": "It is no notebook."})
    jsonschema.validate(found, PRAIRIELEARN)
    assert found == {"gradable": False, "format_errors": ["It is no notebook."]}


def test_prairielearn_gives_no_more_than_ten_minutes(data):
    options = prairielearn.info("image", 480)["externalGradingOptions"]
    assert options == {"enabled": True, "image": "image", "timeout": 540}
    assert prairielearn.info("image", 900)["externalGradingOptions"]["timeout"] == 600


METADATA = {
    "id": 1, "created_at": "2026-03-02T18:00:00.000000-08:00",
    "assignment": {"due_date": "2026-03-01T12:00:00.000000-08:00", "title": "Topics"},
    "users": [{"email": "zoe@example.org", "name": "Zoe"}, {"email": "ann@example.org", "name": "Ann"}],
}  # fmt: skip


def write(path: Path, data: object) -> Path:
    path.write_text(json.dumps(data))
    return path


def test_the_metadata_say_who_submitted_and_when_it_was_due(tmp_path):
    found = gradescope.read_metadata(write(tmp_path / "m.json", METADATA))
    assert (found.student, found.due) == ("ann@example.org", METADATA["assignment"]["due_date"])
    assert found.handed_in == METADATA["created_at"]
    own = copy.deepcopy(METADATA)
    own["users"][1]["assignment"] = {"due_date": "2026-03-05T12:00:00.000000-08:00"}
    extended = gradescope.read_metadata(write(tmp_path / "m.json", own))
    assert extended.due == "2026-03-05T12:00:00.000000-08:00"
    own = METADATA | {"assignment": {"due_date": None}}
    assert gradescope.read_metadata(write(tmp_path / "m.json", own)).due == ""


@pytest.mark.parametrize("data", [{}, {"users": []}, [], {"users": [{"name": "x"}]}])
def test_metadata_without_a_user_are_refused(tmp_path, data):
    with pytest.raises(CourseError, match="does not say who submitted"):
        gradescope.read_metadata(write(tmp_path / "m.json", data))

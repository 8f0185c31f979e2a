"""What holds for every page of the bridge, the chapter after the lessons."""

import functools
import json
import re
from pathlib import Path

import pytest

from grader.marking.release.run_notebooks import execute
from tests.tooling.lesson_times import MOVES

ROOT = Path(__file__).parents[2]
BRIDGE = ROOT / "course" / "bridge"
PAGES = sorted(path.stem for path in BRIDGE.glob("*.ipynb"))
# The others are run by `make solutions`, for each change that is proposed.
EVERY_DAY = "01_ros1"
# What the text of a page says that its cells show.
SHOWN = {
    "01_ros1": ("110 commands", "incompatible function arguments", "6 beats in 5 s"),
    "02_gazebo": (
        "0.7 m ahead, 0 contacts",
        "2.9 m ahead, 1 contacts",
        "lidar: 360 rays up to 3.5 m",
        "True\n",
        "/bumper        std_msgs/msg/Bool  ",
    ),
    "03_control": (
        "'wheel_left_joint': -2.4",
        "incompatible type geometry_msgs",
        "0.85 m",
        "left_wheel_test stays inactive: drive has claimed left_wheel_joint/velocity",
    ),
    "04_dds": (
        ": it drives\n",
        ": it stands still\n",
        "exit status 102",
        "no server:  nothing in 3 s",
        "server:     received hello",
        "one of two: nothing in 3 s",
        "two domains: received hello",
        "the daemon says: /parameter_events /rosout\n",
        "without daemon:  /chatter ",
        "`ros2 daemon` is not available here",
    ),
    "05_security": (
        "enclaves/robot/driver/cert.pem: OK",
        "impostor/cert.pem: verification failed",
        "Verification failure",
        "/enclaves/robot/driver' does not exist",
        "This Fast DDS version doesn't have the security libraries",
    ),
    "06_scripts": (
        "No module named 'scripts'",
        "tool_a circle\ntool_a clock\ntool_a report\n",
        "It is ",
        "79.",
    ),
    "07_learning": (
        "in new worlds:    100%",
        "in the lab: 0%",
        "BrakeThatSees: 0.00 m from the wall, 1 contacts",
        "Brake and Sees: 0.20 m from the wall, 0 contacts",
    ),
    "08_lab": ("reliability: reliable", "261 scans, 20.0 Hz", "age of a scan: 30 ms"),
    "09_questions": ("Driver: 0 contacts", "Circler: 0 contacts", "(median)"),
    "10_nav2": (
        "[17.000] [basic_navigator]: TaskResult.SUCCEEDED",
        "[6.500] [basic_navigator]: TaskResult.CANCELED",
        "[16.500] [basic_navigator]: TaskResult.SUCCEEDED",
        "[26.100] [courier]: Not complete",
        "(17.0, 'succeeded')",
        "[18.000] [desk]: TaskResult.SUCCEEDED",
        "(12.0, 'canceled')",
    ),
    "11_rviz": (
        "360 points, seen from (0.51, 0.21)",
        '"map" passed to lookupTransform argument target_frame does not exist',
        "(4.4, 5.7) in map",
        "/odom | Type: nav_msgs/msg/Odometry | Count: 201",
    ),
    "12_mapping": (
        "clipped at 6.0: 15 scans",
        "clipped at inf: 1275 scans",
        "row 28 column 74 number 5394",
        "where it drove: {'free'}",
        "equal: True",
        "0.196 {-1: ",
        "0.25 {0: ",
    ),
}
PREDICTION = re.compile(r" = predict\(|\.outcome\(")
RUNS = [name if name == EVERY_DAY else pytest.param(name, marks=pytest.mark.soak) for name in PAGES]


def cells(page):
    """Each cell's id, with its source."""
    notebook = json.loads((BRIDGE / f"{page}.ipynb").read_text("utf-8"))
    return {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}


@functools.cache
def outputs(page):
    notebook, stopped = execute(BRIDGE / f"{page}.ipynb")
    assert stopped == ()
    return [output for cell in notebook.cells for output in cell.get("outputs", ())]


@pytest.mark.parametrize("page", RUNS)
def test_a_page_runs_from_top_to_bottom(page):
    assert outputs(page), "a page shows something"
    assert [output.evalue for output in outputs(page) if output.output_type == "error"] == []
    assert [output.text for output in outputs(page) if output.get("name") == "stderr"] == []


@pytest.mark.parametrize("page", RUNS)
def test_the_cells_of_a_page_show_what_its_text_is_about(page):
    text = "".join(output.get("text", "") for output in outputs(page))
    assert [part for part in SHOWN[page] if part not in text] == [], text


@pytest.mark.soak
def test_two_folders_of_scripts_run_one_program_and_two_packages_run_two():
    text = "".join(output.get("text", "") for output in outputs("06_scripts"))
    first, second, *moved = re.findall(r"This is the report of (\w+)", text)
    assert first == second
    assert moved == ["tool_a", "tool_b"]
    first, second, *moved = re.findall(r"turns to the (\w+)", text)
    assert first == second
    assert moved == ["left", "right"]


@pytest.mark.parametrize("page", PAGES)
def test_a_page_says_what_it_takes_and_where_to_read_on(page):
    texts = cells(page)
    assert "**Time:**" in texts["title"] and "(../glossary.md)" in texts["title"]
    assert "**Before you begin:**" in texts["title"]
    assert "From lesson " in texts["check"], "a question on a lesson"
    assert "**Read on" in texts["summary"] and "](https://" in texts["summary"]


@pytest.mark.parametrize("page", PAGES)
def test_a_page_says_what_was_not_run(page):
    assert "**Not run here:**" in "".join(cells(page).values())


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_short(page):
    others = [name for name, source in cells(page).items() if not PREDICTION.search(source)]
    (minutes,) = re.findall(r"\*\*Time:\*\* about (\d+) minutes", cells(page)["title"])
    assert 8 <= len(others) <= 32 and int(minutes) <= 30


@pytest.mark.parametrize("page", PAGES)
def test_something_moves_in_the_first_cells_of_a_page(page):
    first = list(cells(page).values())[:8]
    assert any(MOVES.search(source) for source in first)


@pytest.mark.parametrize("page", PAGES)
def test_a_page_asks_for_predictions_and_its_source_shows_no_outcome(page):
    source = "\n".join(cells(page).values())
    outcomes = re.findall(r"^(\w+)\.outcome\((.*)\)", source, re.M)
    asked = re.findall(r"^(\w+) = predict\(", source, re.M)
    assert [name for name, _ in outcomes] == asked != []
    assert all(re.fullmatch(r'"[0-9a-f]{6}"', code) for _, code in outcomes)


@pytest.mark.parametrize("page", PAGES)
def test_every_link_of_a_page_leads_somewhere(page):
    links = re.findall(r"\]\((?!https://)([^)#]+)\)", "\n".join(cells(page).values()))
    assert [link for link in links if not (BRIDGE / link).exists()] == []


def test_the_last_page_is_the_only_one_without_a_next_one():
    summaries = [cells(page)["summary"] for page in PAGES]
    following = [re.search(r"\*\*Next:\*\* .*?\((\w+)\.ipynb\)", summary, re.S) for summary in summaries]
    assert [found and found[1] for found in following] == [*PAGES[1:], None]

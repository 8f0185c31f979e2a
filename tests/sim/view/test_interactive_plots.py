"""Plots over time are interactive where scripts run: their data, and what a page contains."""

import base64
import dataclasses
import math
import re
import zlib

import pytest
from geometry_msgs.msg import Twist
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from sim import Recording, World, run
from sim.evidence import CallbackError, LogLine
from sim.notebook.shared_scripts import SharedScripts
from sim.view import interactive, plot_jitter, plot_logs, plot_path, plot_signal, plot_topics
from sim.view.field_labels import field_label, is_command, panel_unit
from sim.view.interactive import plot_script, plot_source
from sim.view.packing import inflated
from sim.view.plot_data import FEW, POINTS, series
from sim.world.machines.cart_pole import Push
from tests.sim.recordings import driven, published, recording
from tests.students import misfits


def commands(count=4):
    messages = [(float(n), Twist()) for n in range(count)]
    for n, (_, message) in enumerate(messages):
        message.linear.x, message.angular.z = 0.1 * n, -0.5
    return published("/cmd_vel", messages)


def data(figure):
    (packed,) = re.findall(r'data-plot="([^"]+)"', figure.html)
    return inflated(packed)


def path(figure):
    (packed,) = re.findall(r'data-replay="([^"]+)"', figure.html)
    return inflated(packed)


def test_a_signal_has_a_panel_for_each_unit_and_commands_are_steps():
    found = data(plot_signal(commands(), "/cmd_vel", "linear.x", "angular.z"))
    assert [panel["unit"] for panel in found["panels"]] == ["m/s", "rad/s"]
    ((speed,), (turn,)) = (panel["series"] for panel in found["panels"])
    assert (speed["name"], speed["style"], speed["markers"]) == ("linear.x", "step", True)
    assert (speed["x"], speed["y"]) == ([0, 1, 2, 3], [0, 0.1, 0.2, 0.3])
    assert turn["y"] == [-0.5] * 4
    assert (found["title"], found["begin"], found["end"]) == ("/cmd_vel", 0.0, 10.0)
    assert found["run"] == commands().digest[:12]


def test_a_unit_that_is_given_is_that_of_one_panel():
    found = data(plot_signal(commands(), "/cmd_vel", "linear.x", "angular.z", unit="m/s, rad/s"))
    (panel,) = found["panels"]
    assert panel["unit"] == "m/s, rad/s"
    assert [each["name"] for each in panel["series"]] == ["linear.x", "angular.z"]


def test_joints_are_called_by_their_names():
    states = JointState(name=["slider_joint", "pole_joint"], position=[0.5, 2.0], velocity=[1.0, 0.0])
    assert field_label(states, "position.1") == "pole_joint position"
    fields = ("position.0", "position.1", "velocity.0")
    assert [panel_unit(states, field) for field in fields] == ["m", "rad", "m/s"]
    assert (field_label(states, "position.7"), panel_unit(states, "position.7")) == ("position.7", "")
    assert field_label(Twist(), "linear.x") == "linear.x"
    found = data(plot_signal(published("/joint_states", [(1.0, states)]), "/joint_states", "position.1"))
    assert found["panels"][0]["series"][0]["name"] == "pole_joint position"


@pytest.mark.parametrize(
    ("topic", "kind", "command"),
    [
        ("/robot/cmd_vel", "geometry_msgs/msg/Twist", True),
        ("/speed", "geometry_msgs/msg/TwistStamped", True),
        ("/joint_command", "std_msgs/msg/Float64", True),
        ("/odom", "nav_msgs/msg/Odometry", False),
    ],
)
def test_commands_are_known_by_their_topic_or_type(topic, kind, command):
    assert is_command(topic, kind) is command


def test_many_points_have_no_markers_and_are_limited_in_number():
    many = series("a", list(range(5000)), [0.0] * 5000)
    assert (len(many["x"]), many["x"][0], many["x"][-1], many["markers"]) == (POINTS, 0, 4999, False)
    assert series("a", list(range(FEW)), [0.0] * FEW)["markers"] is True


def test_numbers_that_json_does_not_have_are_gaps():
    assert series("a", [0, 1, 2], [1.23456789, math.nan, math.inf])["y"] == [1.2346, None, None]


def test_topics_and_log_lines_are_rows_of_ticks():
    talk = run(misfits.Talker, misfits.Listener, seconds=5, quiet=True)
    rows = data(plot_topics(talk))["rows"]
    assert [row["name"] for row in rows] == ["/chatter\n5, 1 Hz", "log lines\n5"]
    assert rows[0]["x"] == [1.0, 2.0, 3.0, 4.0, 5.0]
    lines = [LogLine(1.0, "INFO", "a", "x"), LogLine(2.0, "WARN", "a", "y")]
    logs = data(plot_logs(recording(logs=lines)))["rows"]
    assert [(row["name"], row["x"], row["color"]) for row in logs] == [
        ("a, INFO", [1.0], 0),
        ("a, WARN", [2.0], "caution"),
    ]


def test_jitter_has_its_limits_and_marks_what_was_missed():
    sent = published("/n", [(moment, Float64()) for moment in (0.0, 0.1, 0.2, 0.5)])
    (panel,) = data(plot_jitter(sent, "/n", period=0.1, deadline=0.2))["panels"]
    assert panel["levels"] == [[100.0, "period", "muted"], [200.0, "deadline", "caution"]]
    assert [(each["name"], each["x"], each["y"]) for each in panel["series"]] == [
        ("time since the last", [0.1, 0.2, 0.5], [100.0, 100.0, 300.0]),
        ("missed", [0.5], [300.0]),
    ]


def test_what_happened_is_marked():
    error = CallbackError(4.0, "/driver", "Driver.tick", "KeyError", "'x'", "")
    crashed = driven([(0, 0)] * 6, contacts=[(3.2, 3.4, 1.0, 2.0, "front", "wall")], errors=[error])
    assert [mark[:2] for mark in data(plot_topics(crashed))["marks"]] == [
        [3200, "contact"],
        [4000, "error"],
        [5000, "end"],
    ]


def test_a_failure_is_in_the_plot_and_in_the_path():
    error = CallbackError(4.0, "/driver", "Driver.tick", "KeyError", "'x'", "")
    crashed = driven([(0, 0)] * 6, errors=[error])
    assert crashed.failure
    assert data(plot_topics(crashed))["failure"] == crashed.failure
    assert path(plot_path(crashed))["failure"] == crashed.failure


def test_a_path_is_drawn_as_replays_draw_the_world():
    drive = driven([(0, 0), (1, 0), (2, 0)], contacts=[(1.5, 1.6, 1.0, 2.0, "front", "wall")])
    figure = plot_path(drive)
    found = path(figure)
    assert (found["path"], found["run"], found["end"]) == (True, drive.digest[:12], 2.0)
    assert [mark[1] for mark in found["marks"]] == ["contact", "end"]
    assert found["tracks"] == [[[0, 1000, 1000], [0, 0, 0], [0, 0, 0]]]
    assert f' alt="{figure.description}">' in figure.html
    assert len(figure.html.encode()) < 60_000


def test_a_page_with_a_plot_is_small_and_complete():
    figure = plot_signal(commands(2000), "/cmd_vel", "linear.x", "angular.z")
    html = figure.html
    assert len(html.encode()) < 100_000
    assert html.startswith('<div class="ros2-plot" data-plot="')
    assert f' alt="{figure.description}">' in html
    assert html.endswith(f"<script>{plot_script()}</script>")
    assert figure._repr_mimebundle_() == {"text/html": html, "text/plain": repr(figure)}


def test_a_notebook_with_several_plots_contains_their_script_once(monkeypatch):
    scripts = SharedScripts()
    monkeypatch.setattr(interactive, "shared_scripts", lambda: scripts)
    recording = commands(2000)
    pages = []
    for cell in ("first", "second", "third", "first"):
        scripts.begin(cell)
        figure = plot_signal(recording, "/cmd_vel", "linear.x", "angular.z")
        pages.append(figure._repr_mimebundle_()["text/html"])
    assert [plot_script() in page for page in pages] == [True, False, False, True]  # it was replaced
    assert pages[1].endswith("<script>window.ros2CoursePlots?.()</script>")
    without = sum(len(re.search("<img[^>]*>", page)[0]) for page in pages[:3])
    assert sum(map(len, pages[:3])) - without < 100_000


def test_a_deleted_or_running_cell_carries_no_script():
    scripts = SharedScripts()
    assert scripts.is_needed("plots") and scripts.is_needed("plots")  # no notebook
    scripts.begin("a")
    needed = [scripts.is_needed(name) for name in ("plots", "plots", "replays")]
    assert needed == [True, False, True]
    scripts.begin("b")
    scripts.update(["a", "b"])
    assert not scripts.is_needed("plots")
    scripts.update(["b"])
    assert scripts.is_needed("plots") and not scripts.is_needed("plots")


def test_the_script_of_plots_loads_nothing():
    assert re.findall(r"import\s*\(|fetch\(|innerHTML|eval\(|XMLHttpRequest", plot_source()) == []
    (packed,) = re.findall(r'atob\("([^"]*)"\)', plot_script())
    assert plot_source() in zlib.decompress(base64.b64decode(packed), -15).decode()


def test_an_empty_run_has_an_empty_plot():
    assert data(plot_topics(Recording()))["rows"] == []


def test_a_push_is_marked():
    cart = World.load("cart_pole")
    pushes = (Push(begin=1.0, force=5.0), Push(begin=50.0, force=5.0))
    world = dataclasses.replace(cart, machine=dataclasses.replace(cart.machine, pushes=pushes))
    mark, _ = data(plot_topics(run(world=world, seconds=2, quiet=True)))["marks"]
    assert mark == [1000, "push", "t = 1 s: the cart is pushed with 5 N for 0.1 s", None]


def test_a_plot_into_which_more_is_drawn_is_shown_as_it_is():
    figure = plot_signal(commands(), "/cmd_vel", "linear.x")
    assert set(figure._repr_mimebundle_()) == {"text/html", "text/plain"}
    figure.axes[0].plot([0, 1], [0, 1], "k--")
    assert figure._repr_mimebundle_() == {}
    assert figure._repr_png_()[0].startswith(b"\x89PNG")

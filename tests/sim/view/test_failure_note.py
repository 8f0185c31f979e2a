"""Every plot names the failure of its run."""

import html
import re

import pytest
from std_msgs.msg import Float32

from sim import Recording, World
from sim.evidence import CallbackError, Ended, LogLine, Message, Pose
from sim.ros.messages.codec import encode
from sim.view import (
    animate,
    plot_frames,
    plot_graph,
    plot_jitter,
    plot_logs,
    plot_path,
    plot_signal,
    plot_topics,
)
from sim.view.replay import replay

FAILURE = "AttributeError: 'String' object has no attribute 'dta' (in Talker.tick, line 9, at 0.5 s)"
PLOTS = {
    "path": plot_path,
    "topics": plot_topics,
    "logs": plot_logs,
    "graph": plot_graph,
    "frames": plot_frames,
    "signal": lambda recording: plot_signal(recording, "/a"),
    "jitter": lambda recording: plot_jitter(recording, "/a"),
}


@pytest.fixture
def failed() -> Recording:
    trace = '  File "<cell>", line 9, in tick\n'
    text = "'String' object has no attribute 'dta'"
    messages = [
        Message(t, "/a", "std_msgs/msg/Float32", "/b", encode(Float32(data=t))) for t in (0.1, 0.2, 0.3)
    ]
    return Recording(
        world=World.load("room"),
        seconds=3.0,
        stamp=1.0,
        path=[Pose(0.0, 0.0, 0.0, 0.0), Pose(1.0, 0.1, 0.0, 0.0)],
        published=messages,
        logs=[LogLine(0.1, "INFO", "b", "hello")],
        errors=[CallbackError(0.5, "/talker", "Talker.tick", "AttributeError", text, trace)],
        ended=Ended("error", 1.0, ""),
    )


def texts(figure) -> str:
    found = [text.get_text() for text in (*figure.texts, *figure.axes[0].texts)]
    if figure._supxlabel is not None:
        found.append(figure._supxlabel.get_text())
    return re.sub(r"\s+", " ", " ".join(found))


@pytest.mark.parametrize("name", PLOTS)
def test_a_plot_names_the_failure_below_and_in_its_alt_text(failed, name):
    figure = PLOTS[name](failed)
    assert FAILURE in texts(figure)
    assert FAILURE in figure.description
    failed.errors.clear()
    failed.ended = Ended("time", 1.0, "")
    again = PLOTS[name](failed)
    assert "AttributeError" not in texts(again) + again.description


def test_an_animation_names_it_in_its_alt_text(failed):
    description = html.escape(f"The run in the world room, 1 s; {FAILURE}")
    assert f'alt="{description}"' in animate(failed, speed=10)._repr_mimebundle_()["text/html"]


def test_the_view_of_a_play_ends_with_it_above_the_replay(failed, monkeypatch):
    from sim.view import live_view

    shown = []
    monkeypatch.setattr(live_view.LiveView, "_replace_output", lambda self, thing: shown.append(thing))
    for reports in (True, False):
        live_view.LiveView(failed.world, reports=reports).finish(failed)
    first, second = [thing.html for thing in shown if hasattr(thing, "html")]
    assert first.startswith('<div class="ros2-failure"') and "has no attribute" in first
    assert second == replay(failed).html

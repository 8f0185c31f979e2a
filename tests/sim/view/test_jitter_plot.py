import pytest
from std_msgs.msg import String

from sim.view import plot_jitter, png
from tests.sim.recordings import published


def ticks(*moments):
    return published("/tick", [(moment, String()) for moment in moments], seconds=2.0)


def drawn(figure):
    return {line.get_label(): line for line in figure.axes[0].lines}


def test_the_time_between_messages_is_drawn_in_milliseconds():
    figure = plot_jitter(ticks(0.1, 0.2, 0.35, 0.4), "/tick")
    axes, lines = figure.axes[0], drawn(figure)
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_xlim()) == ("time (s)", "ms", (0.0, 2.0))
    assert list(lines) == ["mean", "time since the last"]
    assert lines["mean"].get_ydata() == pytest.approx([100.0, 100.0])
    assert lines["time since the last"].get_xdata() == pytest.approx([0.2, 0.35, 0.4])
    assert lines["time since the last"].get_ydata() == pytest.approx([100.0, 150.0, 50.0])
    assert axes.get_title() == "/tick: 10 Hz, jitter 41 ms"


def test_missed_deadlines_are_red_and_counted():
    figure = plot_jitter(ticks(0.1, 0.2, 0.35, 0.4), "/tick", period=0.1, deadline=0.12)
    lines = drawn(figure)
    assert list(lines) == ["period", "time since the last", "deadline", "missed"]
    assert lines["deadline"].get_ydata() == pytest.approx([120.0, 120.0])
    assert lines["missed"].get_ydata() == pytest.approx([150.0])
    assert figure.axes[0].get_title() == "/tick: 10 Hz, jitter 41 ms, 1 deadline missed"
    title = "/tick: 10 Hz, jitter 41 ms, 1 deadline missed"
    assert figure.description.startswith(f"Plot: {title}; ms over time (s)")


def test_a_deadline_that_is_just_met_is_not_missed():
    figure = plot_jitter(ticks(0.1, 0.2, 0.3), "/tick", period=0.1, deadline=0.1)
    assert list(drawn(figure)) == ["period", "time since the last", "deadline"]
    assert figure.axes[0].get_title().endswith("jitter 0 ms, 0 deadlines missed")


def test_equal_runs_give_equal_pictures():
    one, other = (plot_jitter(ticks(0.1, 0.2, 0.35), "/tick") for _ in range(2))
    assert png(one) == png(other)


@pytest.mark.parametrize(
    ("topic", "options", "sentence"),
    [
        ("/tock", {}, "jitter needs two messages; /tock has 0, and this run has /tick"),
        ("/tick", {"period": 0.0}, "the period is 0.0; give seconds above 0, or leave it out"),
        ("/tick", {"deadline": -1}, "the deadline is -1; give seconds above 0, or leave it out"),
    ],
)
def test_what_has_no_jitter_is_refused(topic, options, sentence):
    with pytest.raises(ValueError) as caught:
        plot_jitter(ticks(0.1, 0.2), topic, **options)
    assert str(caught.value) == sentence

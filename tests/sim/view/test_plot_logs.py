from sim import Recording
from sim.evidence import Ended, LogLine
from sim.view import plot_logs


def drawn(*lines):
    run = Recording(seconds=4.0, logs=[LogLine(*line) for line in lines], ended=Ended("time", 4.0, ""))
    (axes,) = plot_logs(run).axes
    return axes


def test_a_row_for_each_logger_and_a_color_for_each_level():
    axes = drawn((1.0, "INFO", "pump", "a"), (2.0, "ERROR", "pump", "b"), (3.0, "INFO", "robot1.lamp", "c"))
    strokes = {line.get_label(): (list(line.get_xdata()), list(line.get_ydata())) for line in axes.lines}
    assert strokes == {"INFO": ([1.0, 3.0], [0, 1]), "ERROR": ([2.0], [0])}
    assert [label.get_text() for label in axes.get_yticklabels()] == ["pump", "robot1.lamp"]
    assert len({line.get_color() for line in axes.lines}) == 2


def test_time_runs_to_the_end_of_the_run():
    left, right = drawn((1.0, "INFO", "pump", "a")).get_xlim()
    assert left < 0 < 4.0 < right


def test_a_silent_run_is_an_empty_picture():
    assert drawn().lines[:] == []

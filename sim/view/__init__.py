"""Pictures of a recording. The only part of the simulation that knows matplotlib and Jupyter."""

from sim.view.animation import animate
from sim.view.figure import png, small_png
from sim.view.frames import plot_frames
from sim.view.graph import plot_graph
from sim.view.map import plot_map
from sim.view.pace import plot_jitter
from sim.view.replay import replay
from sim.view.scene import plot_path
from sim.view.timeline import plot_logs, plot_signal, plot_topics

__all__ = [
    "animate",
    "plot_frames",
    "plot_graph",
    "plot_jitter",
    "plot_logs",
    "plot_map",
    "plot_path",
    "plot_signal",
    "plot_topics",
    "png",
    "replay",
    "small_png",
]

"""Plots, replays and the live view of runs. The only package of sim that imports matplotlib and Jupyter."""

from sim.view.animation import animate
from sim.view.ellipse_plot import plot_ellipses
from sim.view.frames_plot import plot_frames
from sim.view.graph_plot import plot_graph
from sim.view.jitter_plot import plot_jitter
from sim.view.map_plot import plot_map
from sim.view.path_plot import plot_path
from sim.view.plot import png, small_png
from sim.view.prediction import predict
from sim.view.replay import replay
from sim.view.scans_plot import plot_scans
from sim.view.timeline_plots import plot_logs, plot_signal, plot_topics

__all__ = [
    "animate",
    "plot_ellipses",
    "plot_frames",
    "plot_graph",
    "plot_jitter",
    "plot_logs",
    "plot_map",
    "plot_path",
    "plot_scans",
    "plot_signal",
    "plot_topics",
    "png",
    "predict",
    "replay",
    "small_png",
]

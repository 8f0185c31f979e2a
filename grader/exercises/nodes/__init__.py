"""The exercises of 01_nodes: log lines, timers, levels, names, a whole main(), a module of one's own."""

from grader.exercises.nodes.ending import whole_main
from grader.exercises.nodes.levels import battery
from grader.exercises.nodes.modules import weather
from grader.exercises.nodes.names import heart
from grader.exercises.nodes.starting import counter, hello

__all__ = ["battery", "counter", "heart", "hello", "weather", "whole_main"]

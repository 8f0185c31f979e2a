"""The exercises of 01_nodes: log lines, timers, levels, names, a whole main(), a module of one's own."""

from grader.exercises.nodes.battery import battery
from grader.exercises.nodes.counter import counter
from grader.exercises.nodes.heart import heart
from grader.exercises.nodes.hello import hello
from grader.exercises.nodes.weather import weather
from grader.exercises.nodes.whole_main import whole_main

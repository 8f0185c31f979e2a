"""The exercises of 02_topics, from a publisher in one line to a robot that drives a square."""

from grader.exercises.topics.driving import remapping, square
from grader.exercises.topics.listening import chatters, commands
from grader.exercises.topics.partners import Chatterbox, CommandSender, OneMetre
from grader.exercises.topics.publishing import greeting, imu, temperature

__all__ = [
    "Chatterbox",
    "CommandSender",
    "OneMetre",
    "chatters",
    "commands",
    "greeting",
    "imu",
    "remapping",
    "square",
    "temperature",
]

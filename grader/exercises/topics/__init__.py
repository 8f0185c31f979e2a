"""The exercises of 02_topics, from a publisher in one line to a robot that drives a square."""

from grader.companions.random_publishers import Chatterbox, CommandSender
from grader.exercises import notebook_names

globals().update(notebook_names(__name__))

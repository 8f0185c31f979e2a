"""The exercises of 02_topics, from a publisher in one line to a robot that drives a square."""

from grader.companions.one_meter import OneMeter
from grader.companions.random_publishers import Chatterbox, CommandSender
from grader.exercises.topics.chatters import chatters
from grader.exercises.topics.commands import commands
from grader.exercises.topics.greeting import greeting
from grader.exercises.topics.imu import imu
from grader.exercises.topics.remapping import remapping
from grader.exercises.topics.square import square
from grader.exercises.topics.temperature import temperature

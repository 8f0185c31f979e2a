"""A robot's commands: what this robot puts up with, and a real one would not."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

from grader.diagnosis.rays import NO_WAY, rays_without_distance
from sim.evidence import Recording, Seconds
from sim.ros2.system import OWN_NAME
from sim.world.robot import RobotModel

_TWIST = "geometry_msgs/msg/Twist"
_SOME = 2  # times that something is no accident any more
_STUCK, _TYPO = 1.5, 0.02  # s and m: no brief touch, and no box that gives way
_SILENT = RobotModel().command_timeout  # s after which most robots stop by themselves
_STOP = (
    "This robot stops by itself when no commands arrive; other robots drive on. Publish a Twist() with all "
    "zeros at the end."
)
_STOP_TRUSTING = (
    "This robot obeys its last command until the next one arrives: silence doesn't stop it. Publish a "
    "Twist() with all zeros at the end."
)


class VelocityCommand(NamedTuple):
    """A velocity command: m/s forwards, rad/s to the left."""

    stamp: Seconds
    sender: str
    v: float
    w: float

    @property
    def words(self) -> str:
        """The two numbers with their units."""
        return f"{self.v:.3g} m/s and {self.w:.3g} rad/s"

    @property
    def moves(self) -> bool:
        """Return whether it is anything but a stop."""
        return bool(self.v or self.w)


def refused_command(recording: Recording) -> str:
    """A command that is not a number: the robot refuses it."""
    for topic, commands in of_robots(recording):
        for bad in commands:
            if not (math.isfinite(bad.v) and math.isfinite(bad.w)):
                rays = rays_without_distance(recording, bad.sender, bad.stamp)
                return (
                    f"{bad.sender} sent {bad.words} on {topic} at {bad.stamp:.3g} s, and the robot refuses "
                    "anything that isn't a finite number. "
                    f"{rays or 'Print the values it is calculated from.'}"
                )
    return ""


def drives_against_it(recording: Recording) -> str:
    """Commands to drive on, while the robot touches something and gets no further."""
    for contact in recording.contacts:
        soon = contact.stamp + _STUCK
        if (contact.end or recording.ended.stamp) < soon or _way(recording, contact.stamp, soon) > _TYPO:
            continue
        wanted = -1 if contact.side == "back" else 1
        for topic, commands in of_robots(recording):
            sent = (command for command in commands if not recording.is_course_node(command.sender))
            meant = [command for command in sent if contact.stamp < command.stamp < soon]
            if topic == "/cmd_vel" and meant and all(command.v * wanted > 0 for command in meant):
                rays = rays_without_distance(recording, meant[-1].sender, meant[-1].stamp, NO_WAY)
                return (
                    f"The robot's {contact.side} touched a {contact.what} at {contact.stamp:.3g} s, and "
                    f"{meant[-1].sender} keeps driving against it: {meant[-1].words} at "
                    f"{meant[-1].stamp:.3g} s. "
                    f"{rays or 'Stop earlier, as soon as the lidar sees something near.'}"
                )
    return ""


def _way(recording: Recording, begin: Seconds, end: Seconds) -> float:
    """Return how far the robot got between two moments, m."""
    one, other = recording.pose_at(begin), recording.pose_at(end)
    return math.hypot(other.x - one.x, other.y - one.y)


def two_drivers(recording: Recording) -> str:
    """Two nodes that command one robot, each against the other."""
    for topic, commands in of_robots(recording):
        fights = [
            (one, other)
            for one, other, again in zip(commands, commands[1:], commands[2:], strict=False)
            if one.sender == again.sender != other.sender
            and again.stamp - one.stamp <= _SILENT
            and one[2:] != other[2:]
        ]
        if len(fights) > _SOME:
            one, other = fights[0]
            return (
                f"{one.sender} and {other.sender} both publish on {topic}, and the robot obeys the latest "
                f"command: at {one.stamp:.3g} s {one.words}, at {other.stamp:.3g} s {other.words}. Let one "
                "node command the robot, and have the other one send its requests to that node."
            )
    return ""


def rare_commands(recording: Recording) -> str:
    """Commands so far apart that the robot stops by itself between them."""
    timeout = _timeout(recording)
    for topic, commands in of_robots(recording):
        passing_on = _passing_on(recording, topic)
        pauses = [
            after.stamp - before.stamp
            for before, after in itertools.pairwise(commands)
            if before.moves
            and after.moves
            and after.stamp - before.stamp > timeout + 1e-6
            and before.sender not in passing_on
        ]
        if len(pauses) >= _SOME:
            return (
                f"{commands[0].sender} lets up to {max(pauses):.3g} s pass between two commands on {topic}, "
                f"but the robot stops by itself {timeout:g} s after each: repeat the command at 10 Hz, from "
                "a timer."
            )
    return ""


def left_driving(recording: Recording) -> str:
    """A last command that is no stop, after which at most the robot's own time-out stops it.

    `ros2 topic pub --times` can't send a stop after its messages.
    """
    for topic, last in _left(recording):
        if last.sender not in _passing_on(recording, topic) and not last.sender.startswith(f"/{OWN_NAME}"):
            return f"The {_command_text(topic, last)}. {how_to_stop(recording)}"
    return ""


def how_to_stop(recording: Recording) -> str:
    """Return what to do about a last command that is no stop."""
    return _STOP_TRUSTING if _timeout(recording) > _SILENT else _STOP


def last_command_that_moves(recording: Recording) -> str:
    """Return what is said of a last command that is no stop, after which the program is silent; or ""."""
    return next((f"the {_command_text(*left)}" for left in _left(recording)), "")


def still_obeyed(recording: Recording, stamp: Seconds) -> str:
    """The hint where the robot moves at a time because nothing followed a command that moves it; or ""."""
    for topic, commands in of_robots(recording):
        last = next((command for command in reversed(commands) if command.stamp <= stamp), None)
        if last and last.moves and stamp - last.stamp > _SILENT:
            return (
                f"The robot still obeys its last command, {last.words} on {topic} at {last.stamp:.3g} s: "
                "silence is not a stop. Send zeros."
            )
    return ""


def _command_text(topic: str, last: VelocityCommand) -> str:
    return f"last command on {topic}, at {last.stamp:.3g} s, was {last.words}"


def _left(recording: Recording) -> Iterator[tuple[str, VelocityCommand]]:
    """The topics whose last command is no stop, and that command."""
    for topic, commands in of_robots(recording):
        last = commands[-1]
        if last.moves and recording.ended.stamp - last.stamp > _SILENT + 1e-6:
            yield topic, last


def _timeout(recording: Recording) -> Seconds:
    return recording.world.robot.command_timeout if recording.world else math.inf


def _passing_on(recording: Recording, topic: str) -> set[str]:
    """The nodes that subscribe to other commands, as a mux does: it is silent while those are."""
    return {end.node for end in recording.graph.subscriptions() if end.type == _TWIST and end.name != topic}


def of_robots(recording: Recording) -> Iterator[tuple[str, list[VelocityCommand]]]:
    """The topic of each robot's commands, with those of the student's nodes among them, if there are any."""
    for end in recording.graph.subscriptions():
        if end.type != _TWIST or end.node not in recording.course_nodes or not end.node.endswith("/robot"):
            continue
        commands = [
            VelocityCommand(sent.stamp, sent.sender, sent.message.linear.x, sent.message.angular.z)
            for sent in recording.messages(end.name)
        ]
        if any(not recording.is_course_node(command.sender) for command in commands):
            yield end.name, commands

"""Helpers: plays on a clock of the test's own, so that no test waits for the wall's."""

import itertools

from sim.ros.play.pacing import Pace
from sim.ros.play.player import Player
from sim.ros.session import Session

ODD = (0.0031, 0.017, 0.0004, 0.041, 0.0073, 0.09, 0.0119)  # s between two looks at the clock


class Clock:
    """A clock on which time passes whenever someone looks at it, by lengths that fit no period."""

    def __init__(self, steps=ODD):
        self.now, self.steps = 100.0, itertools.cycle(steps)

    def __call__(self):
        self.now += next(self.steps)
        return self.now


class Watcher:
    """A picture that stores its updates."""

    def __init__(self):
        self.on_command = None
        self.frames, self.states, self.graphs, self.finished, self.closed = [], [], [], [], 0

    def frame(self, stamp, poses, scan):
        self.frames.append((stamp, poses, scan))

    def state(self, state):
        self.states.append(state)

    def connections(self, recording):
        self.graphs.append(len(recording.graph.endpoints))

    def finish(self, recording):
        self.finished.append(recording)

    def close(self):
        self.closed += 1


def player(*nodes, world=None, seconds=10.0, seed=0, until=None, quiet=True, speed=1.0, clock=None):
    """A player that goes on only when its `turn` is called."""
    session = Session(nodes, world, seconds, seed, until, quiet, caller="play")
    return Player(session, Pace(speed, clock or Clock()))


def watched(made, picture=None):
    """The same player with a picture, and the picture; without an event loop of its own."""
    picture = picture or Watcher()
    made.show(picture)
    return picture


def to_the_end(made, meanwhile=lambda: None):
    """Let it play to its end, with something else done after each frame."""
    while not made.over:
        made.play_frame()
        meanwhile()
    return made.recording

"""The exercises of 09_frames, from the place of a lidar to a follower, and transforms that come late."""

from grader.exercises.frames.broadcasting import Wheels, odometry
from grader.exercises.frames.delayed import SlowLocalization, delayed
from grader.exercises.frames.finding import Watcher, watch
from grader.exercises.frames.following import behind
from grader.exercises.frames.looking import lookup
from grader.exercises.frames.mounting import Mechanic, mount
from grader.exercises.frames.partners import localization
from grader.exercises.frames.places import convoy, parked, square
from grader.exercises.frames.team import Team

__all__ = [
    "Mechanic",
    "SlowLocalization",
    "Team",
    "Watcher",
    "Wheels",
    "behind",
    "convoy",
    "delayed",
    "localization",
    "lookup",
    "mount",
    "odometry",
    "parked",
    "square",
    "watch",
]

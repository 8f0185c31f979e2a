"""The exercises of 09_frames, from the place of a lidar to a follower, and transforms that come late."""

from grader.exercises.frames.broadcasting import Wheels, odometry
from grader.exercises.frames.finding import Watcher, watch
from grader.exercises.frames.following import follow
from grader.exercises.frames.late import SlowLocalization, late
from grader.exercises.frames.looking import Team, lookup
from grader.exercises.frames.mounting import Mechanic, mount
from grader.exercises.frames.partners import localization
from grader.exercises.frames.places import convoy, parked, square

__all__ = [
    "Mechanic",
    "SlowLocalization",
    "Team",
    "Watcher",
    "Wheels",
    "convoy",
    "follow",
    "late",
    "localization",
    "lookup",
    "mount",
    "odometry",
    "parked",
    "square",
    "watch",
]

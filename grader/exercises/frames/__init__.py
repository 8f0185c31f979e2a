"""The exercises of 09_frames, from the place of a lidar to a follower, and transforms that come late."""

from grader.companions.lidar_mount import Mechanic
from grader.companions.moving_frames import SlowLocalization, WheelOdometry
from grader.companions.sightings import Team
from grader.companions.tower_watcher import Watcher
from grader.companions.transforms import localization
from grader.exercises.frames.behind import behind
from grader.exercises.frames.delayed import delayed
from grader.exercises.frames.lookup import lookup
from grader.exercises.frames.mount import mount
from grader.exercises.frames.odometry import odometry
from grader.exercises.frames.watch import watch
from grader.worlds.frame_worlds import convoy, parked, square

"""The text cards of generated worlds."""

from sim.world.obstacles import Point

_TOPICS = "Takes /cmd_vel; gives /odom, /scan, /bumper, /joint_states, /tf, /tf_static and /clock."
_FRAMES = (
    "Meters, radians, seconds. map: the world, x to the right of the picture, y up. "
    "odom: where the robot started. base_link: the robot, x forward, y left. base_scan: its lidar."
)


def card(picture: str, start: str, topics: str = _TOPICS) -> str:
    """The text of a card; the parameters are what differs between worlds."""
    return "\n".join(
        (
            f"Picture: {picture}",
            f"Topics: {topics}",
            f"Frames and units: {_FRAMES}",
            f"Start: {start}",
            "Ends when: The time of the run is over.",
        )
    )


def goal_at(goal: Point) -> str:
    """A phrase with the goal's position (m)."""
    return f"The goal is at x {goal[0]:g}, y {goal[1]:g}"


def contents(*things: tuple[str, str, int]) -> str:
    """A list such as ", 3 boxes and 1 pillar" from ("box", "boxes", 3), ...; without items of count 0."""
    items = [f"{count} {one if count == 1 else many}" for one, many, count in things if count]
    return "".join(f"{' and' if item is items[-1] else ','} {item}" for item in items)

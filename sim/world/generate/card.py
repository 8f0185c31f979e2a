"""The cards of generated worlds."""

from sim.world.obstacles import Point

_TOPICS = "Takes /cmd_vel; gives /odom, /scan, /bumper, /joint_states, /tf, /tf_static and /clock."
_FRAMES = (
    "Metres, radians, seconds. map: the world, x to the right of the picture, y up. "
    "odom: where the robot started. base_link: the robot, x forward, y left. base_scan: its lidar."
)


def card(picture: str, start: str, topics: str = _TOPICS) -> str:
    """The text of a card, from what is different in each."""
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
    """Where the goal is, m."""
    return f"The goal is at x {goal[0]:g}, y {goal[1]:g}"


def furnished(*things: tuple[str, str, int]) -> str:
    """Such as ", 3 boxes and 1 pillar" of ("box", "boxes", 3), ...; what there is none of is left out."""
    words = [f"{count} {one if count == 1 else many}" for one, many, count in things if count]
    return "".join(f"{' and' if word is words[-1] else ','} {word}" for word in words)

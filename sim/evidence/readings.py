"""The strip of values beside a picture: the pose of the robot or the machine, its command, its sensors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from sim.evidence.message_text import MAX_ITEMS
from sim.world import Contact, World

SLIDING = ("slider_joint",)  # moves along a line
Newest = Callable[..., Any]  # of a topic and the types that it may have: the newest message, or None


def readings(
    world: World | None,
    pose: Sequence[float] | None,
    newest: Newest,
    ranges: Sequence[float] | None,
    contacts: Sequence[Contact],
    orders: Sequence[Any] = (),
) -> Iterator[tuple[str, str]]:
    """Pairs of a label and a text.

    pose: x, y (m) and yaw (rad) of the robot or turtle that can be driven; None for a machine, whose joints
    are shown. newest: see `Newest`. ranges: of the robot's newest scan (m). contacts: all so far.
    orders: the messages of a warehouse's desk so far.
    """
    if world is None or pose is None:
        yield from _joints(newest)
        return
    x, y, yaw = pose
    yield from (("x", f"{x:.2f} m"), ("y", f"{y:.2f} m"), ("yaw", f"{yaw:.2f} rad"))
    odom = newest("/odom", "nav_msgs/msg/Odometry")
    if odom is not None:
        yield "v", f"{odom.twist.twist.linear.x:.2f} m/s"
        yield "ω", f"{odom.twist.twist.angular.z:.2f} rad/s"
    yield from _command("/cmd_vel" if world.machine is None else f"/{world.driven_body}/cmd_vel", newest)
    yield from _sensors(world, newest, ranges)
    if world.goal is not None:
        yield "goal", f"{math.dist((x, y), world.goal):.2f} m"
    if world.warehouse is not None:
        yield from _orders(orders, str(world.driven_body))
    if world.machine is None and odom is not None:
        yield "contacts", f"{len(contacts)}, at {contacts[-1].stamp:.1f} s" if contacts else "none"


def _orders(orders: Sequence[Any], robot: str) -> Iterator[tuple[str, str]]:
    """The order that the robot carries, how many others wait, and how many were delivered, by any robot."""
    kinds: Any = type(orders[-1]) if orders else None  # its constants are what a status can be
    newest = {order.id: order for order in orders}.values()
    carried = [order.id for order in newest if order.robot == robot and order.status == kinds.PICKED_UP]
    yield "carries", f"order {carried[-1]}" if carried else "nothing"
    yield "orders waiting", f"{sum(order.status == kinds.WAITING for order in newest)}"
    yield "delivered", f"{sum(order.status == kinds.DELIVERED for order in newest)}"


def _command(topic: str, newest: Newest) -> Iterator[tuple[str, str]]:
    command = newest(topic, "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")
    twist = getattr(command, "twist", command)  # of a TwistStamped
    yield "command v", "none yet" if twist is None else f"{twist.linear.x:.2f} m/s"
    yield "command ω", "none yet" if twist is None else f"{twist.angular.z:.2f} rad/s"


def _joints(newest: Newest) -> Iterator[tuple[str, str]]:
    """The positions of a machine's joints: radians, or meters of a cart."""
    joints = newest("/joint_states", "sensor_msgs/msg/JointState")
    if joints is not None:
        for name, position in list(zip(joints.name, joints.position, strict=False))[:MAX_ITEMS]:
            yield name, f"{position:.2f} {'m' if name in SLIDING else 'rad'}"


def _sensors(world: World, newest: Newest, ranges: Sequence[float] | None) -> Iterator[tuple[str, str]]:
    if ranges is not None:
        hits = [(float(reach), ray) for ray, reach in enumerate(ranges) if math.isfinite(reach)]
        reach, ray = min(hits, default=(math.inf, 0))
        angle = math.remainder(ray * world.lidar.angle_increment + world.lidar.yaw, math.tau)
        yield "nearest", f"{reach:.2f} m" if hits else "none"
        yield "at", f"{angle:.2f} rad" if hits else "none"
    bumper = newest("/bumper", "std_msgs/msg/Bool")
    if bumper is not None:
        yield "bumper", "pressed" if bumper.data else "free"
    battery = newest("/battery_state", "sensor_msgs/msg/BatteryState")
    if battery is not None:
        yield "battery", f"{100 * battery.percentage:.0f} %"

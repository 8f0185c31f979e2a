"""Recordings of a warehouse written by hand: orders, batteries, and where the robot was."""

import itertools
import math

from builtin_interfaces.msg import Time
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Header
from warehouse_msgs.msg import Order

from sim import World
from sim.evidence import Pose
from sim.nanoseconds import EPOCH, SECOND
from sim.world import WarehouseModel
from tests.sim.recordings import exchange

HALL = World("hall", "", (-9, -9, 9, 9), (0, 0, 0), warehouse=WarehouseModel(((0, 0, 0),), (1.5, 0, 0)))
STATUS = {
    "waiting": Order.WAITING,
    "picked up": Order.PICKED_UP,
    "delivered": Order.DELIVERED,
    "expired": Order.EXPIRED,
    "canceled": Order.CANCELED,
}


def stamp(seconds):
    """A time of the run as messages have it."""
    nanoseconds = EPOCH + round(seconds * SECOND)
    return Time(sec=nanoseconds // SECOND, nanosec=nanoseconds % SECOND)


def order(id, *, patience=100.0, robot="", **stamps):
    """The messages of an order that reached each of these statuses at a time; `picked_up` as in a message."""
    begin = stamps["waiting"]
    times = {"header": Header(stamp=stamp(begin)), "deadline": stamp(begin + patience)}
    states = [(at, STATUS[name.replace("_", " ")]) for name, at in stamps.items()]
    return [(at, Order(id=id, status=status, robot=robot, **times)) for at, status in states]


def drive(*corners, period=0.1):
    """Poses along corners, each given as a stamp, x, y and, where it isn't 0, yaw."""
    path = []
    for (begin, *here), (end, *there) in itertools.pairwise([(*corner, 0.0)[:4] for corner in corners]):
        count = math.ceil((end - begin) / period - 1e-9)
        for n in range(count):
            place = (a + (b - a) * n / count for a, b in zip(here, there, strict=True))
            path.append(Pose(begin + (end - begin) * n / count, *place))
    return [*path, Pose(*(*corners[-1], 0.0)[:4])]


def worked(*orders, path=(), battery=(), seconds=30.0, world=HALL, **evidence):
    """A run in a warehouse. battery: pairs of stamp and share."""
    rows = sorted(itertools.chain(*orders), key=lambda pair: pair[0])
    streams = [("/orders", rows, True)] if orders else []
    if battery:
        states = [(at, BatteryState(percentage=share)) for at, share in battery]
        streams.append(("/battery_state", states, True))
    run = exchange(*streams, seconds=seconds)
    run.world, run.path = world, list(path)
    for name, value in evidence.items():
        setattr(run, name, value)
    return run

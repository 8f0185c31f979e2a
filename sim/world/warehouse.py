"""What makes a floor a warehouse: places where goods are fetched and handed over, and how orders come in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from sim.world.model import Model, Wanted, positive, within
from sim.world.robot import Pose

_POSE = "[x, y, yaw] (metres and radians)"
_POSES = f"a list of one or more poses {_POSE}"


def _are_moments(stamps: tuple[float, ...]) -> bool:
    return all(stamp >= 0 for stamp in stamps)


@dataclass(frozen=True)
class WarehouseModel(Model):
    """Where a robot stands to pick up and to deliver (map frame), and the orders (s, and shares of all).

    An order comes every `interval` on average and has to be delivered within `patience`; of all orders the
    share `canceled` is taken back before that. A robot that stands at a place for `handling` gets the load or
    hands it over, and it carries one at a time. At each moment of `withdrawn` (s) an order is canceled, too:
    what is being carried, or else the oldest one.
    """

    pickups: Annotated[tuple[Pose, ...], Wanted(_POSES, bool)]
    desk: Annotated[Pose, Wanted(_POSE)]
    interval: Annotated[float, positive("seconds", 100_000)] = 40.0
    patience: Annotated[float, positive("seconds", 100_000)] = 150.0
    canceled: Annotated[float, within(0, 1)] = 0.1
    handling: Annotated[float, within(0.1, 1000, "seconds")] = 1.0
    withdrawn: Annotated[tuple[float, ...], Wanted("a list of moments (s), 0 or later", _are_moments)] = ()

"""The warehouse of a world: pickup and delivery poses, and how orders arrive."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from sim.world.robot import Pose
from sim.world.validated_model import Constraint, Model, positive, within

_POSE = "[x, y, yaw] (meters and radians)"
_POSES = f"a list of one or more poses {_POSE}"
_MOMENTS = "a list of moments (s), 0 or later"


def _are_moments(stamps: tuple[float, ...]) -> bool:
    return all(stamp >= 0 for stamp in stamps)


@dataclass(frozen=True)
class WarehouseModel(Model):
    """The poses at which a robot picks up and delivers (map frame), and the rate of orders (s, fractions).

    An order arrives every `interval` on average and must be delivered within `patience`; the fraction
    `canceled` of all orders is canceled before that. A robot that stays at a pose for `handling` receives the
    load or hands it over; it carries one load at a time. At each time in `withdrawn` (s) one more order is
    canceled: the one that is being carried, or else the oldest one.
    """

    pickups: Annotated[tuple[Pose, ...], Constraint(_POSES, bool)]
    desk: Annotated[Pose, Constraint(_POSE)]
    interval: Annotated[float, positive("seconds", 100_000)] = 40.0
    patience: Annotated[float, positive("seconds", 100_000)] = 150.0
    canceled: Annotated[float, within(0, 1)] = 0.1
    handling: Annotated[float, within(0.1, 1000, "seconds")] = 1.0
    withdrawn: Annotated[tuple[float, ...], Constraint(_MOMENTS, _are_moments)] = ()

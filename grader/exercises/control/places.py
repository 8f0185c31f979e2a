"""Worlds of 10_control, drawn from a seed: carts of several kinds, and a hall with a wall ahead."""

from __future__ import annotations

import itertools
import random
from dataclasses import replace

from sim import World
from sim.world import LidarModel
from sim.world.machines import CartPoleModel, Push

WEAK = 3.0  # N, the motor of the cart that is sent to marks
LONG = 30.0  # m of track
NOISE, POOR = 0.002, 0.01  # rad, of the angle that is measured
PUSHES = (6.0, 9.0), (12.0, 15.0)  # s, when somebody pushes
PUSHED = 0.7, 1.0  # N s


def long_track(seed: int) -> World:
    """A cart that has room enough to roll away: of its pole, only the angle matters."""
    draw = random.Random(f"long_track {seed}")
    figures = {"pole_length": draw.uniform(0.14, 0.17), "pole_friction": 0.0002, "track_length": LONG}
    return _cart("long_track", seed, replace(_drawn(seed), **figures))


def weak_cart(seed: int) -> World:
    """A cart on the track of 2 m whose motor is weak."""
    return _cart("weak_cart", seed, _drawn(seed, max_force=WEAK))


def hopeless_cart(seed: int) -> World:
    """A cart whose motor can't hold the pole."""
    return _cart("hopeless_cart", seed, _drawn(seed, max_force=0.1, track_length=LONG))


def work_cart(seed: int) -> World:
    """A cart whose angle is measured poorly: nobody can leave its pole alone for long."""
    return _cart("work_cart", seed, _drawn(seed, angle_noise=POOR))


def pushed_cart(seed: int) -> World:
    """A cart and a pole of any mass and length, which is pushed twice, once from each side."""
    draw = random.Random(f"pushed_cart {seed}")
    masses = {"cart_mass": draw.uniform(0.35, 0.8), "pole_mass": draw.uniform(0.06, 0.2)}
    sides = draw.sample((-1.0, 1.0), 2)
    pushes = tuple(
        Push(round(draw.uniform(*when), 2), round(side * draw.uniform(*PUSHED) / 0.1, 2))
        for when, side in zip(PUSHES, sides, strict=True)
    )
    masses |= {"angle_noise": NOISE}
    model = CartPoleModel(pole_length=draw.uniform(0.25, 0.5), pushes=pushes, track_length=3.0, **masses)
    return _cart("pushed_cart", seed, model)


def ramp(seed: int) -> World:
    """A hall with a wall straight ahead, 2.2 m to 3 m away: the lidar sees it, noise and all."""
    ahead = round(random.Random(f"ramp {seed}").uniform(2.2, 3.0), 2)
    left, low, right, top = -1.5, -1.0, ahead, 1.0
    corners = [(left, low), (right, low), (right, top), (left, top), (left, low)]
    return World(
        name=f"ramp_{seed}",
        card="Picture: A hall that goes up towards the wall ahead.",
        bounds=(left, low, right, top),
        walls=tuple(itertools.pairwise(corners)),
        lidar=LidarModel(noise=0.03),
    )


def _drawn(seed: int, **figures: float) -> CartPoleModel:
    """A cart that is a little lighter or heavier than the lesson's, with a pole that differs more."""
    draw = random.Random(f"cart {seed}")
    figures.setdefault("angle_noise", NOISE)
    return CartPoleModel(
        cart_mass=draw.uniform(0.45, 0.6),
        pole_mass=draw.uniform(0.08, 0.13),
        pole_length=draw.uniform(0.27, 0.36),
        **figures,
    )


def _cart(name: str, seed: int, model: CartPoleModel) -> World:
    half = model.track_length / 2 + 0.2
    end = half - 0.1
    rail = ((-end, 0.05), (-end, -0.05), (end, -0.05), (end, 0.05))
    return replace(
        World.load("cart_pole"),
        name=f"{name}_{seed}",
        card=f"Picture: A cart of {model.cart_mass:.2g} kg on a track of {model.track_length:g} m carries a "
        f"pole of {model.pole_length:.2g} m.",
        bounds=(-half, -0.65, half, 0.65),
        walls=tuple(itertools.pairwise(rail)),
        machine=model,
    )

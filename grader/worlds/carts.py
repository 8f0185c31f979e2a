"""Carts that carry a pole, drawn from a seed: with weak motors, poor sensors, or pushes."""

import itertools
import random
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from sim import World
from sim.world.machines import CartPoleModel, Push

WEAK = 3.0  # N, the motor of the cart that is sent to marks
LONG = 30.0  # m of track
NOISE, POOR = 0.002, 0.01  # rad, of the angle that is measured
PUSHES = (6.0, 9.0), (12.0, 15.0)  # s, when the cart is pushed
PUSHED = 0.7, 1.0  # N s


def long_track(seed: int) -> World:
    """Return a cart that has room enough to roll away: of its pole, only the angle matters."""
    draw = random.Random(f"long_track {seed}")
    pole = draw.uniform(0.14, 0.17)
    model = replace(_drawn(seed), pole_length=pole, pole_friction=0.0002, track_length=LONG)
    return _cart("long_track", seed, model)


def pushed_cart(seed: int) -> World:
    """Return a cart and a pole of any mass and length, which is pushed twice, once from each side."""
    draw = random.Random(f"pushed_cart {seed}")
    cart, pole = draw.uniform(0.35, 0.8), draw.uniform(0.06, 0.2)
    sides = draw.sample((-1.0, 1.0), 2)
    pushes = tuple(
        Push(round(draw.uniform(*when), 2), round(side * draw.uniform(*PUSHED) / 0.1, 2))
        for when, side in zip(PUSHES, sides, strict=True)
    )
    model = CartPoleModel(
        cart_mass=cart, pole_mass=pole, pole_length=draw.uniform(0.25, 0.5), angle_noise=NOISE,
        track_length=3.0, pushes=pushes,
    )
    return _cart("pushed_cart", seed, model)


def _drawn(seed: int, **figures: Any) -> CartPoleModel:
    """A cart that is a little lighter or heavier than the lesson's, with a pole that differs more."""
    draw = random.Random(f"cart {seed}")
    cart, pole, length = draw.uniform(0.45, 0.6), draw.uniform(0.08, 0.13), draw.uniform(0.27, 0.36)
    model = CartPoleModel(cart_mass=cart, pole_mass=pole, pole_length=length, angle_noise=NOISE)
    return replace(model, **figures)


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


def _cart_with(name: str, **figures: float) -> Callable[[int], World]:
    """A function of the seed that draws a cart with these figures."""
    return lambda seed: _cart(name, seed, _drawn(seed, **figures))


weak_cart = _cart_with("weak_cart", max_force=WEAK)
hopeless_cart = _cart_with("hopeless_cart", max_force=0.1, track_length=LONG)  # it can't hold the pole
work_cart = _cart_with("work_cart", angle_noise=POOR)  # its pole can't be left alone for long

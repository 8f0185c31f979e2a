"""A cart-pole: a cart on a straight track with a freely swinging pole, to be balanced."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from sim.world.bodies import Body
from sim.world.machines.machine import Machine, MachineWorld, Pose, bar
from sim.world.robot import DT, RATE, CommandError
from sim.world.validated_model import Angle, Constraint, Length, Model, at_least, positive, within

GRAVITY = 9.81
"""m/s^2, downwards in the picture."""
# The default pole, falling freely, conserves energy to 6e-8 over 20 s with 0.005 s; to 2e-6 with 0.01 s.
_SUBSTEPS = 2
_H = DT / _SUBSTEPS
# The fastest motion that a substep resolves: phase of a swing (rad), and fraction of a decay time constant.
_FASTEST_SWING, _FASTEST_DECAY = 0.1, 0.5
# Iterations to find when the cart hits an end of the track; each one doubles the number of correct digits.
_NEWTON_STEPS = 3
CART = (0.2, 0.1)
"""Width and height of the cart in pictures, m."""
_POLE_THICKNESS = 0.02


class CartPoleState(NamedTuple):
    """The cart's position on the track (m, to the right) and the pole's angle (rad), with their rates.

    The angle is 0 for an upright pole, counter-clockwise, and not wrapped: at pi and -pi the pole hangs down.
    """

    x: float
    angle: float
    v: float
    w: float


@dataclass(frozen=True)
class Push(Model):
    """A disturbance: a force (N, to the right) on the cart, from a time on (s), for a duration (s)."""

    begin: Annotated[float, at_least(0, "s")]
    force: Annotated[float, within(-1000, 1000, "N")]
    seconds: Annotated[float, positive("s", 1000)] = 0.1


@dataclass(frozen=True)
class CartPoleModel(Model):
    """A cart, and a pole with all of its mass at the tip, seen from the side (m, kg, s, rad, N).

    With force F, cart and pole mass M and m, length l, angle a (0 upright, counter-clockwise):
        (M + m) x'' - m l cos(a) a'' + m l sin(a) a'^2 = F - cart_friction x'
        m l^2 a'' - m l cos(a) x'' - m g l sin(a) = - pole_friction a'

    Attributes:
        track_length: the cart moves up to half of it from the center; the ends stop it without a rebound.
        cart_friction, pole_friction: N per m/s and N m per rad/s.
        start_angle, start_spread: the initial angle, plus or minus a random part up to the spread.
        max_force: the motor's greatest force in either direction.
        command_timeout: the motor turns off after this time without a command.
        position_noise, angle_noise: standard deviations of the measurements (m, rad).
        pushes: disturbances; their forces add to the motor's.
    """

    cart_mass: Annotated[float, within(0.01, 1000, "kg")] = 0.5
    pole_mass: Annotated[float, positive("kg", 1000, 1e-12)] = 0.1  # the least: hardly any pole
    pole_length: Length = 0.3
    track_length: Length = 2.0
    cart_friction: Annotated[float, at_least(0, "N per m/s")] = 0.1
    pole_friction: Annotated[float, at_least(0, "N m per rad/s")] = 0.002
    start_angle: Angle = 0.1
    start_spread: Annotated[float, at_least(0, "radians")] = 0.05
    max_force: Annotated[float, positive("N", 1000)] = 10.0
    command_timeout: Annotated[float, positive("s", 1000)] = 0.2
    position_noise: Annotated[float, at_least(0, "meters")] = 0.0
    angle_noise: Annotated[float, at_least(0, "radians")] = 0.0
    pushes: Annotated[tuple[Push, ...], Constraint("a list of Push")] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        heaviness = 1 + self.pole_mass / self.cart_mass
        shortest = heaviness * GRAVITY * (_H / _FASTEST_SWING) ** 2
        if self.pole_length < shortest:
            self.reject("pole_length", f"at least {shortest:.2g} (meters) for these masses")
        most = _FASTEST_DECAY / _H * self.cart_mass
        if self.cart_friction > most:
            self.reject("cart_friction", f"{most:.2g} (N per m/s) or less for this mass")
        most = _FASTEST_DECAY / _H * self.pole_mass * self.pole_length**2 / heaviness
        if self.pole_friction > most:
            self.reject("pole_friction", f"{most:.2g} (N m per rad/s) or less for this pole")

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The cart, and the pole with its x axis from the cart to its tip."""
        width, height = CART
        corners = ((-width, -height), (width, -height), (width, height), (-width, height))
        cart = Body("cart", "cart", outline=tuple((x / 2, y / 2) for x, y in corners))
        return cart, Body("pole", "link", outline=bar(self.pole_length, _POLE_THICKNESS))

    def accelerations(
        self, state: tuple[float, float, float, float], force: float, held: bool = False
    ) -> tuple[float, float]:
        """Return x'' (m/s^2) and a'' (rad/s^2) under a force (N) on the cart.

        held: the cart is stopped at an end of the track, which blocks motion outwards but not inwards.
        """
        x, angle, v, w = state
        c, s = math.cos(angle), math.sin(angle)
        m, length = self.pole_mass, self.pole_length
        drag = self.pole_friction * w / length
        push = force - self.cart_friction * v + m * s * (GRAVITY * c - length * w * w) - c * drag
        along = push / (self.cart_mass + m * s * s)
        if held and along * x > 0:
            along = 0.0
        return along, (c * along + GRAVITY * s - drag / m) / length

    def energy(self, state: CartPoleState) -> float:
        """Kinetic plus potential energy, J; 0 at rest with a horizontal pole."""
        _, angle, v, w = state
        m, length = self.pole_mass, self.pole_length
        swing = length * w
        kinetic = (self.cart_mass + m) * v * v / 2 + m * swing * (swing / 2 - math.cos(angle) * v)
        return kinetic + m * GRAVITY * length * math.cos(angle)


class CartPole(Machine):
    """The simulated cart-pole; `world.machine` is its `CartPoleModel`.

    The seed is for the pole's initial angle and the measurement noise.
    """

    def __init__(self, world: MachineWorld, seed: int = 0) -> None:
        super().__init__(world)
        self.model: CartPoleModel = world.machine
        self._rng = np.random.Generator(np.random.PCG64(seed))
        spread = self.model.start_spread
        self.state = CartPoleState(0.0, self.model.start_angle + self._rng.uniform(-spread, spread), 0.0, 0.0)
        self._force = self._push_force = 0.0
        self._steps_left = 0

    @property
    def poses(self) -> list[Pose]:
        """The poses of cart and pole in the map frame."""
        x, angle, _, _ = self.state
        return [self._placed(x, 0.0, 0.0), self._placed(x, 0.0, angle + math.pi / 2)]

    def command(self, force: float) -> None:
        """Set the motor's force (N, to the right), clamped to `max_force`.

        `model.command_timeout` (s) after the last command the motor turns off.

        Raises:
            CommandError: the force is infinite or not a number.
        """
        if not math.isfinite(force):
            raise CommandError(
                f"Efforts are finite numbers (N); this one was {force}: check how it was calculated."
            )
        self._force = min(max(force, -self.model.max_force), self.model.max_force)
        self._steps_left = round(self.model.command_timeout * RATE)

    def measure(self) -> CartPoleState:
        """The sensors' measurement now: the state, with noise on position and angle."""
        model, state = self.model, self.state
        if not (model.position_noise or model.angle_noise):
            return state
        x_error, angle_error = self._rng.standard_normal(2)
        x = state.x + model.position_noise * x_error
        angle = state.angle + model.angle_noise * angle_error
        return state._replace(x=float(x), angle=float(angle))

    def _step(self) -> None:
        if self._steps_left:
            self._steps_left -= 1
        else:
            self._force = 0.0
        self._push_force = 0.0
        for push in self.model.pushes:
            if push.begin <= self.time < push.begin + push.seconds:
                self._push_force += push.force
        for _ in range(_SUBSTEPS):
            self.state = self._advanced(self.state, _H)

    def _advanced(self, state: CartPoleState, h: float) -> CartPoleState:
        """The state h seconds later. A cart that hits an end of the track stops there."""
        end = math.copysign(self.model.track_length / 2, state.x + h * state.v)
        held = state.x == end and state.v == 0.0
        after = self._integrated(state, h, held)
        if abs(after.x) <= abs(end):
            return after
        until = h
        for _ in range(_NEWTON_STEPS):
            if after.v * end <= 0:  # it is already moving back: the impact was weak
                break
            until = min(max(until - (after.x - end) / after.v, 0.0), h)
            after = self._integrated(state, until, held)
        # The impact acts on the cart only and preserves the pole's angular momentum about the cart.
        spin = after.w - math.cos(after.angle) * after.v / self.model.pole_length
        return self._advanced(CartPoleState(end, after.angle, 0.0, spin), h - until)

    def _integrated(self, state: CartPoleState, h: float, held: bool) -> CartPoleState:
        """The state h seconds later by the classic fourth-order Runge-Kutta method."""
        accelerations, force = self.model.accelerations, self._force + self._push_force
        x, a, v, w = state
        half = h / 2
        dv1, dw1 = accelerations(state, force, held)
        v2, w2 = v + half * dv1, w + half * dw1
        dv2, dw2 = accelerations((x + half * v, a + half * w, v2, w2), force, held)
        v3, w3 = v + half * dv2, w + half * dw2
        dv3, dw3 = accelerations((x + half * v2, a + half * w2, v3, w3), force, held)
        v4, w4 = v + h * dv3, w + h * dw3
        dv4, dw4 = accelerations((x + h * v3, a + h * w3, v4, w4), force, held)
        return CartPoleState(
            x + h / 6 * (v + 2 * v2 + 2 * v3 + v4),
            a + h / 6 * (w + 2 * w2 + 2 * w3 + w4),
            v + h / 6 * (dv1 + 2 * dv2 + 2 * dv3 + dv4),
            w + h / 6 * (dw1 + 2 * dw2 + 2 * dw3 + dw4),
        )

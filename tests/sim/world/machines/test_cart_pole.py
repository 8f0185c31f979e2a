"""The cart and its pole against closed forms of mechanics."""

import dataclasses
import math
import random

import pytest

from sim.world import CommandError, World, WorldError
from sim.world.machines import CartPoleModel, CartPoleState, Push
from sim.world.machines.cart_pole import GRAVITY
from tests.sim.world.machines.machines import alone, steps

FREE = CartPoleModel(
    cart_friction=0, pole_friction=0, start_angle=0, start_spread=0, track_length=100, max_force=1000
)
M, m, LENGTH = FREE.cart_mass, FREE.pole_mass, FREE.pole_length
EXACT = 1e-6


def started(state, model=FREE):
    cart_pole = alone(model)
    cart_pole.state = state
    return cart_pole


def crossings(cart_pole, seconds, value):
    """The moments (s) at which a value of the state rises through zero, between steps on a straight line."""
    found, before = [], value(cart_pole.state)
    for t in steps(cart_pole, seconds):
        now = value(cart_pole.state)
        if before < 0 <= now:
            found.append(t - 0.01 * now / (now - before))
        before = now
    return found


def test_a_hanging_pole_swings_with_the_period_of_its_closed_form():
    """Small swings with a free cart: omega^2 = (M + m) g / (M l). A swing of 1e-4 rad adds less than 1e-9."""
    cart_pole = started(CartPoleState(0.0, math.pi + 1e-4, 0.0, 0.0))
    found = crossings(cart_pole, 20, lambda state: state.angle - math.pi)
    period = (found[-1] - found[0]) / (len(found) - 1)
    assert period == pytest.approx(math.tau / math.sqrt((M + m) * GRAVITY / (M * LENGTH)), rel=EXACT)


def test_an_upright_pole_falls_as_in_the_closed_form():
    """Small angles: angle = angle_0 cosh(t sqrt((M + m) g / (M l)))."""
    cart_pole = started(CartPoleState(0.0, 1e-6, 0.0, 0.0))
    rate = math.sqrt((M + m) * GRAVITY / (M * LENGTH))
    for t in steps(cart_pole, 1):
        assert cart_pole.state.angle == pytest.approx(1e-6 * math.cosh(rate * t), rel=EXACT)


@pytest.mark.parametrize("angle", [0.05, 1.0, 3.0])
def test_without_friction_energy_and_momentum_stay(angle):
    cart_pole = started(CartPoleState(0.0, angle, 0.0, 0.0))
    energy = FREE.energy(cart_pole.state)
    for _ in steps(cart_pole, 20):
        state = cart_pole.state
        assert FREE.energy(state) == pytest.approx(energy, abs=EXACT * 2 * m * GRAVITY * LENGTH)
        momentum = (M + m) * state.v - m * LENGTH * math.cos(state.angle) * state.w
        assert momentum == pytest.approx(0.0, abs=EXACT)


def test_friction_takes_energy_at_the_rate_of_its_power():
    """Over one step, at speeds v and w: dE/dt = - b v^2 - c w^2."""
    model = dataclasses.replace(FREE, cart_friction=0.3, pole_friction=0.05)
    cart_pole = started(CartPoleState(0.0, 2.0, 0.5, 3.0), model)
    lost = 0.0
    before = cart_pole.state
    for _ in steps(cart_pole, 2):
        now = cart_pole.state
        power = [0.3 * s.v**2 + 0.05 * s.w**2 for s in (before, now)]
        lost += sum(power) / 2 * 0.01
        before = now
    energy = model.energy(CartPoleState(0.0, 2.0, 0.5, 3.0))
    assert model.energy(before) == pytest.approx(energy - lost, rel=1e-3)


def test_a_cart_alone_accelerates_with_force_by_mass():
    cart_pole = started(CartPoleState(0.0, 0.0, 0.0, 0.0), dataclasses.replace(FREE, pole_mass=1e-12))
    for t in steps(cart_pole, 2):
        cart_pole.command(3.0)
        cart_pole.advance(t)
    for t in steps(cart_pole, 0.1):
        assert cart_pole.state.x == pytest.approx(3.0 / M * (t - 0.01) ** 2 / 2, abs=EXACT)
        assert cart_pole.state.v == pytest.approx(3.0 / M * (t - 0.01), abs=EXACT)


def test_viscous_friction_gives_a_final_speed():
    """v = F / b (1 - exp(-b t / M))."""
    model = dataclasses.replace(FREE, pole_mass=1e-12, cart_friction=2.0)
    cart_pole = started(CartPoleState(0.0, 0.0, 0.0, 0.0), model)
    cart_pole.command(3.0)
    for t in steps(cart_pole, 0.2):
        assert cart_pole.state.v == pytest.approx(1.5 * (1 - math.exp(-2.0 * t / M)), abs=EXACT)


@pytest.mark.parametrize("side", [1, -1])
def test_the_end_of_the_track_stops_the_cart_and_the_pole_swings_on(side):
    """The blow keeps the pole's angular momentum about the cart: w jumps by - cos(angle) v / l."""
    model = dataclasses.replace(FREE, track_length=1.0, pole_mass=1e-12)
    cart_pole = started(CartPoleState(0.0, 0.0, side * 1.0, 0.0), model)
    hit = []
    for t in steps(cart_pole, 1):
        if abs(cart_pole.state.v) < EXACT and not hit:
            hit.append(t)
    assert hit == [pytest.approx(0.5, abs=0.0101)]
    assert cart_pole.state.x == pytest.approx(side * 0.5, abs=EXACT)
    # from the blow on the pole is a pendulum about a point: its energy is that of the blow
    energy = LENGTH * cart_pole.state.w**2 / 2 + GRAVITY * math.cos(cart_pole.state.angle)
    assert energy == pytest.approx(1.0 / LENGTH / 2 + GRAVITY, rel=EXACT)


def test_the_moment_of_the_blow_is_found_between_two_steps():
    """The cart is 0.12345 s from the end; from the blow on, the hanging pole swings: w / rate sin(rate t)."""
    speed, since, rate = 1e-4, 0.5 - 0.12345, math.sqrt(GRAVITY / LENGTH)
    model = dataclasses.replace(FREE, track_length=1.0, pole_mass=1e-12)
    cart_pole = started(CartPoleState(0.5 - 0.12345 * speed, math.pi, speed, 0.0), model)
    cart_pole.advance(0.5)
    swing = speed / LENGTH / rate
    assert cart_pole.state.angle - math.pi == pytest.approx(swing * math.sin(rate * since), rel=EXACT)


def test_a_cart_at_the_end_can_go_back():
    model = dataclasses.replace(FREE, track_length=1.0)
    cart_pole = started(CartPoleState(0.5, math.pi, 0.0, 0.0), model)
    cart_pole.command(10.0)
    cart_pole.advance(0.1)
    assert (cart_pole.state.x, cart_pole.state.v) == (0.5, 0.0)
    cart_pole.command(-10.0)
    cart_pole.advance(0.2)
    assert cart_pole.state.x < 0.49


@pytest.mark.parametrize("seed", range(20))
def test_no_command_moves_the_cart_off_its_track_and_impacts_add_no_energy(seed):
    """Energy rises by no more than the motor's work: force times way, here with twice the greatest speed."""
    rng = random.Random(seed)
    model = dataclasses.replace(
        FREE,
        pole_mass=rng.uniform(0.01, 2), pole_length=rng.uniform(0.2, 2), track_length=0.5, max_force=20,
    )  # fmt: skip
    cart_pole = started(CartPoleState(rng.uniform(-0.25, 0.25), rng.uniform(-3, 3), 0.0, 0.0), model)
    for step in range(2000):
        before = cart_pole.state
        if step % 30 == 0:
            force = rng.uniform(-20, 20)
        cart_pole.command(force)
        cart_pole.advance((step + 1) / 100)
        after = cart_pole.state
        assert abs(after.x) <= 0.25
        speed = max(abs(before.v), abs(after.v)) + 0.01 * 20 / M
        assert model.energy(after) - model.energy(before) <= 20 * 0.01 * 2 * speed


def test_a_command_is_cut_and_ends_after_its_timeout():
    model = dataclasses.replace(FREE, cart_mass=1.0, pole_mass=1e-12, max_force=5.0, command_timeout=0.2)
    cart_pole = started(CartPoleState(0.0, math.pi, 0.0, 0.0), model)
    cart_pole.command(80.0)
    cart_pole.advance(0.2)
    assert cart_pole.state.v == pytest.approx(1.0)
    cart_pole.advance(1.0)
    assert cart_pole.state.v == pytest.approx(1.0)


@pytest.mark.parametrize("command", [math.nan, math.inf])
def test_a_command_that_is_no_number_is_refused(command):
    cart_pole = alone(FREE)
    with pytest.raises(CommandError) as caught:
        cart_pole.command(command)
    assert str(caught.value) == (
        f"Efforts are finite numbers (N); this one was {command}: check how it was calculated."
    )


def test_the_seed_sets_the_first_angle_within_the_spread():
    model = dataclasses.replace(FREE, start_angle=1.0, start_spread=0.1)
    angles = [alone(model, seed).state.angle for seed in range(200)]
    assert all(0.9 <= angle <= 1.1 for angle in angles)
    assert max(angles) - min(angles) > 0.19
    assert angles[3] == alone(model, 3).state.angle


def test_noise_has_its_standard_deviation_and_leaves_the_truth_alone():
    model = dataclasses.replace(FREE, position_noise=0.01, angle_noise=0.02)
    noisy = alone(model)
    seen = [noisy.measure() for _ in range(4000)]
    for values, deviation in (([s.x for s in seen], 0.01), ([s.angle for s in seen], 0.02)):
        mean = sum(values) / len(values)
        assert mean == pytest.approx(0.0, abs=4 * deviation / math.sqrt(len(values)))
        spread = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
        assert spread == pytest.approx(deviation, rel=0.05)
    assert noisy.state == CartPoleState(0.0, 0.0, 0.0, 0.0)
    assert alone(FREE).measure() is not None


def test_a_push_gives_cart_and_pole_its_momentum_and_ends():
    pushes = (Push(0.5, 3.0, 0.1), Push(0.55, -1.0))
    cart_pole = started(CartPoleState(0.0, 0.3, 0.0, 0.0), dataclasses.replace(FREE, pushes=pushes))
    momentum = {}
    for t in steps(cart_pole, 1):
        _, angle, v, w = cart_pole.state
        momentum[round(t, 2)] = (M + m) * v - m * LENGTH * math.cos(angle) * w
    assert momentum[0.5] == pytest.approx(0.0, abs=EXACT)
    assert momentum[0.55] == pytest.approx(0.15, abs=EXACT)
    assert (momentum[0.65], momentum[1.0]) == pytest.approx((0.2, 0.2), abs=EXACT)


def test_bodies_are_cart_and_pole_where_they_are():
    cart_pole = started(CartPoleState(0.5, 0.1, 0.0, 0.0))
    assert [(body.name, body.kind) for body in cart_pole.world.bodies] == [("cart", "cart"), ("pole", "link")]
    assert cart_pole.poses == [(0.5, 0.0, 0.0), (0.5, 0.0, pytest.approx(math.pi / 2 + 0.1))]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"cart_mass": 0}, "cart_mass is 0; write a number from 0.01 to 1000 (kg)."),
        ({"pole_friction": -1}, "pole_friction is -1; write a number from 0 to 1000000 (N m per rad/s)."),
        ({"pole_length": math.inf}, "pole_length is inf; write a number from 0.0001 to 1000 (meters)."),
        ({"max_force": "5"}, "max_force is '5'; write a number from 0.0001 to 1000 (N)."),
        ({"pole_length": 0.01}, "pole_length is 0.01; write at least 0.029 (meters) for these masses."),
        ({"pushes": [1.0]}, "pushes is [1.0]; write a list of Push."),
        ({"cart_friction": 60}, "cart_friction is 60.0; write 50 (N per m/s) or less for this mass."),
        (
            {"pole_friction": 2},
            "pole_friction is 2.0; write 0.75 (N m per rad/s) or less for this pole.",
        ),
    ],
)
def test_invalid_parameters(values, sentence):
    with pytest.raises(WorldError) as caught:
        CartPoleModel(**values)
    assert str(caught.value) == f"CartPoleModel: {sentence}"


def test_a_world_with_pushes_is_stored():
    world = dataclasses.replace(World.load("cart_pole"), machine=CartPoleModel(pushes=[Push(1.0, 2.0)]))
    assert World.from_data(world.to_data()) == world

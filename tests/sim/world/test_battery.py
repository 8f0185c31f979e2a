"""A battery: what driving takes, what a charger gives, and that an empty one stops the robot."""

import pytest

from sim.world import BatteryModel, Simulation, World

FAR = (9.0, 9.0)
BOUNDS = (-10, -10, 10, 10)


def world(**parameters):
    parameters = {"charger": FAR} | parameters
    return World("test", "", BOUNDS, (0, 0, 0), battery=BatteryModel(**parameters))


def drive(simulation, v, w, until):
    for tenth in range(round(simulation.time * 10) + 1, round(until * 10) + 1):
        simulation.robot.command(v, w)
        simulation.advance(tenth / 10)


def test_standing_takes_the_idle_current():
    simulation = Simulation(world(start=0.5))
    simulation.advance(36)
    battery = simulation.robot.battery
    assert battery.charge == pytest.approx(0.025 - 0.001)
    assert (battery.current, battery.voltage) == (-0.1, pytest.approx(11 + 0.48 * 1.6))


@pytest.mark.parametrize(("v", "w", "wheels"), [(0.5, 0.0, 0.5), (-0.5, 0.0, 0.5), (0.0, 2.0, 0.16)])
def test_driving_takes_more_by_the_speed_of_the_wheels(v, w, wheels):
    simulation = Simulation(world())
    drive(simulation, v, w, 2)
    battery = simulation.robot.battery
    assert battery.current == pytest.approx(-0.1 - 0.8 * wheels)
    before = battery.charge
    drive(simulation, v, w, 12)
    assert before - battery.charge == pytest.approx((0.1 + 0.8 * wheels) * 10 / 3600)


def test_a_charger_fills_it_and_no_further():
    simulation = Simulation(world(charger=(0.1, 0.0), start=0.5))
    simulation.advance(12)
    battery = simulation.robot.battery
    assert battery.charge == pytest.approx(0.035) and battery.current == 3.0
    simulation.advance(60)
    assert (battery.percentage, battery.current, battery.voltage) == (1.0, 0.0, 12.6)


def test_with_an_empty_one_the_robot_stops_for_good():
    simulation = Simulation(world(start=0.02))
    drive(simulation, 0.5, 0.0, 20)
    stopped, battery = simulation.robot.pose, simulation.robot.battery
    assert battery.is_empty and 2.5 < stopped[0] < 4.5
    drive(simulation, 0.5, 1.0, 25)
    assert simulation.robot.pose == pytest.approx(stopped)


def test_without_one_a_robot_never_tires():
    assert Simulation(World("test", "", BOUNDS, (0, 0, 0))).robot.battery is None

"""The picture of a believed pose: its path, the true one, and ellipses of the right size and direction."""

import math
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.patches import Ellipse

from sim import World, run
from sim.view import plot_ellipses
from sim.view.ellipse_plot import ellipse
from sim.world import WheelModel
from tests.students.engine import drivers


def test_an_ellipse_has_half_axes_of_2_45_standard_deviations_in_its_direction():
    turn = np.array([[math.cos(0.3), -math.sin(0.3)], [math.sin(0.3), math.cos(0.3)]])
    patch = ellipse(1.0, 2.0, turn @ np.diag([0.04, 0.25]) @ turn.T)
    assert patch.center == (1.0, 2.0)
    assert (patch.width, patch.height) == pytest.approx((2 * 2.45 * 0.2, 2 * 2.45 * 0.5))
    assert math.radians(patch.angle) % math.pi == pytest.approx(0.3)


def test_95_percent_of_the_positions_are_inside():
    rng = np.random.default_rng(1)
    spread = np.array([[0.04, 0.01], [0.01, 0.09]])
    points = rng.multivariate_normal((0, 0), spread, 4000)
    squares = np.einsum("ni,ij,nj->n", points, np.linalg.inv(spread), points)
    assert np.mean(squares <= 2.45**2) == pytest.approx(0.95, abs=0.015)


def test_a_plot_has_both_paths_and_an_ellipse_every_so_often():
    world = replace(World.load("yard"), wheels=WheelModel(slip=0.01), start=(0.5, -0.5, 1.0))
    figure = plot_ellipses(run(drivers.Circler, world=world, seconds=3, quiet=True), every=1.0)
    (axes,) = figure.axes
    assert {line.get_label() for line in axes.lines} >= {"true path", "/odom"}
    ellipses = [patch for patch in axes.patches if isinstance(patch, Ellipse) and patch.get_alpha() == 0.3]
    assert len(ellipses) == 4
    assert ellipses[-1].width * ellipses[-1].height > ellipses[1].width * ellipses[1].height > 0.0
    true, believed = (next(line for line in axes.lines if line.get_label() == name).get_xydata()
                      for name in ("true path", "/odom"))  # fmt: skip
    assert believed[0] == pytest.approx((0.5, -0.5)) == true[0]
    assert 0 < np.linalg.norm(believed[-1] - true[-1]) < 0.1


def test_a_topic_without_a_covariance_is_an_error():
    recording = run(world="yard", seconds=0.2, quiet=True)
    with pytest.raises(ValueError, match="no message on /scan has a pose with a covariance; check the topic"):
        plot_ellipses(recording, "/scan")

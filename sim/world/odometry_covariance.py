"""The covariance of wheel odometry: how it grows with the distance that the wheels roll."""

from __future__ import annotations

import math

PoseCovariance = tuple[float, float, float, float, float, float, float, float, float]
"""Of x, y (m) and yaw (rad), row by row, in the axes of the odom frame."""
TwistCovariance = tuple[float, float, float, float]
"""Of v (m/s) and w (rad/s), row by row."""


class PoseSpread:
    """The covariance of a pose that wheel odometry calculates; it starts at 0.

    track: distance between the wheels, m. slip: standard deviation of a wheel's distance after 1 m, m; the
    errors of different stretches are independent. radius_error, track_error: standard deviations of relative
    errors that are constant.

    The arithmetic is in plain Python, whose results are equal on every machine, to the last bit.
    """

    def __init__(self, track: float, slip: float, radius_error: float, track_error: float) -> None:
        self._track, self._per_meter = track, slip**2
        self._random = [0.0] * 6  # xx, xy, x yaw, yy, y yaw, yaw yaw: of what differs from step to step
        # The pose's derivatives by the constant errors (left and right radius, track), with their variances.
        variances = radius_error**2, radius_error**2, track_error**2
        self._constant = [([0.0, 0.0, 0.0], variance) for variance in variances]

    def add(self, left: float, right: float, heading: float) -> None:
        """Add a step in which the wheels rolled by `left` and `right` (m); `heading` (rad): in its middle."""
        if not (left or right):
            return
        distance, turn = (left + right) / 2, (right - left) / self._track
        c, s = math.cos(heading), math.sin(heading)
        across, along = -distance * s, distance * c  # what a heading error adds to x and y, m/rad
        by_turn = across / 2, along / 2, 1.0  # the pose's derivatives by this step's turn
        by_left, by_right = (
            (c / 2 + side * by_turn[0], s / 2 + side * by_turn[1], side)
            for side in (-1 / self._track, 1 / self._track)
        )
        xx, xy, xt, yy, yt, tt = self._random
        self._random = [
            xx + 2 * across * xt + across * across * tt,
            xy + across * yt + along * xt + across * along * tt,
            xt + across * tt,
            yy + 2 * along * yt + along * along * tt,
            yt + along * tt,
            tt,
        ]
        for derivatives, rolled in ((by_left, left), (by_right, right)):
            _add_square(self._random, derivatives, self._per_meter * abs(rolled))
        steps = ((by_left, left), (by_right, right), (by_turn, -turn))
        for (total, _), (derivatives, factor) in zip(self._constant, steps, strict=True):
            total[0] += across * total[2] + factor * derivatives[0]
            total[1] += along * total[2] + factor * derivatives[1]
            total[2] += factor * derivatives[2]

    def covariance(self, yaw: float, reading: float) -> PoseCovariance:
        """The covariance at a yaw (rad); reading: standard deviation of a wheel's distance as read, m."""
        sums = list(self._random)
        for derivatives, variance in self._constant:
            _add_square(sums, derivatives, variance)
        for side in (-1 / self._track, 1 / self._track):
            _add_square(sums, (math.cos(yaw) / 2, math.sin(yaw) / 2, side), reading * reading)
        xx, xy, xt, yy, yt, tt = sums
        return xx, xy, xt, xy, yy, yt, xt, yt, tt


def _add_square(sums: list[float], vector: tuple[float, ...] | list[float], factor: float) -> None:
    """Add the upper triangle of a vector's outer product with itself, times a factor."""
    x, y, t = vector
    for index, product in enumerate((x * x, x * y, x * t, y * y, y * t, t * t)):
        sums[index] += factor * product

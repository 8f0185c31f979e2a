"""Gyros that can be calibrated: right ones, and wrong ones named by their defect."""

import statistics
from collections import deque

import example_interfaces.srv
import numpy as np
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64
from std_srvs.srv import Trigger


class Gyro(Node):
    """As one would write it."""

    type, service = Trigger, "/gyro/calibrate"

    def __init__(self):
        super().__init__("gyro")
        self.readings = deque(maxlen=50)
        self.bias = 0.0
        self.publisher = self.create_publisher(Float64, "/gyro/rate", 10)
        self.create_subscription(Float64, "/gyro/raw", self.on_message, 10)
        self.create_service(self.type, self.service, self.calibrate)

    def on_message(self, msg):
        self.readings.append(msg.data)
        self.publisher.publish(Float64(data=msg.data - self.bias))

    def calibrate(self, request, response):
        if len(self.readings) < 50:
            response.message = f"only {len(self.readings)} of 50 readings yet"
            return response
        self.bias = sum(self.readings) / len(self.readings)
        response.success = True
        response.message = f"bias {self.bias:.3f} rad/s"
        return response


class GyroWithNumpy(Gyro):
    def calibrate(self, request, response):
        enough = len(self.readings) == self.readings.maxlen
        if enough:
            self.bias = float(np.mean(self.readings))
        message = f"Calibrated: {self.bias:+.5f} rad/s from 50 readings." if enough else "Too early!"
        return Trigger.Response(success=enough, message=message)


class AsyncGyro(Gyro):
    """A design of its own: keeps all readings, and looks at the last 50 in a coroutine."""

    def __init__(self):
        super().__init__()
        self.readings = []

    async def calibrate(self, request, response):
        last = self.readings[-50:]
        try:
            if len(last) < 50:
                raise ValueError("not enough readings")
            self.bias = statistics.fmean(last)
            response.success, response.message = True, f"the bias is now {self.bias}"
        except ValueError as error:
            response.success, response.message = False, str(error)
        return response


def main(args=None):
    """A program of functions."""
    rclpy.init(args=args)
    node = rclpy.create_node("imu_driver")
    state = {"window": np.zeros(50), "count": 0, "bias": 0.0}
    publisher = node.create_publisher(Float64, "gyro/rate", 10)

    def on_raw(msg):
        state["window"][state["count"] % 50] = msg.data
        state["count"] += 1
        publisher.publish(Float64(data=msg.data - state["bias"]))

    def on_calibrate(request, response):
        response.success = state["count"] >= 50
        if response.success:
            state["bias"] = state["window"].mean()
            node.get_logger().info("calibrated")
        response.message = f"{state['bias']:.4f}" if response.success else "wait a little"
        return response

    node.create_subscription(Float64, "gyro/raw", on_raw, 10)
    node.create_service(Trigger, "gyro/calibrate", on_calibrate)
    rclpy.spin(node)


class MisspeltService(Gyro):
    service = "/gyro/calibration"


class TriggerOfAnotherPackage(Gyro):
    type = example_interfaces.srv.Trigger


class ForgetsReturn(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)


class NeverRefuses(Gyro):
    """Takes what there is."""

    def calibrate(self, request, response):
        self.bias = sum(self.readings) / max(len(self.readings), 1)
        return Trigger.Response(success=True, message=f"{self.bias:.3f}")


class DividesByZero(Gyro):
    """Before the first reading there is no mean."""

    def calibrate(self, request, response):
        self.bias = sum(self.readings) / len(self.readings)
        return Trigger.Response(success=True, message=f"{self.bias:.3f}")


class RaisesInPlaceOfRefusing(Gyro):
    def calibrate(self, request, response):
        if len(self.readings) < 50:
            raise RuntimeError("too few readings")
        return super().calibrate(request, response)


class RefusesWithoutReason(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)
        if not response.success:
            response.message = ""
        return response


class BiasNotKept(Gyro):
    """A variable of the method, not of the node."""

    def calibrate(self, request, response):
        if len(self.readings) < 50:
            return Trigger.Response(success=False, message="too early")
        bias = sum(self.readings) / len(self.readings)
        return Trigger.Response(success=True, message=f"{bias:.3f}")


class AddsTheBias(Gyro):
    def on_message(self, msg):
        self.readings.append(msg.data)
        self.publisher.publish(Float64(data=msg.data + self.bias))


class MeanOfAllReadings(Gyro):
    """Good the first time, but the gyro becomes warmer."""

    def __init__(self):
        super().__init__()
        self.readings = []


class SuccessNeverSet(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)
        response.success = False
        return response


class MessageWithoutNumber(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)
        if response.success:
            response.message = "calibrated"
        return response


class SumInPlaceOfMean(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)
        if response.success:
            self.bias = sum(self.readings)
            response.message = f"{self.bias:.3f}"
        return response


class NumberForMessage(Gyro):
    def calibrate(self, request, response):
        super().calibrate(request, response)
        response.message = self.bias
        return response


class PublishesNothing(Gyro):
    def on_message(self, msg):
        self.readings.append(msg.data)


class AlwaysZero(Gyro):
    """Knows that a robot at rest doesn't turn."""

    def on_message(self, msg):
        self.readings.append(msg.data)
        self.publisher.publish(Float64(data=0.0))


class NeverComesBack(Gyro):
    """A loop without end in the callback."""

    def calibrate(self, request, response):
        while True:
            pass


class OneReadingTooMany(Gyro):
    """Wants more readings than are kept."""

    def calibrate(self, request, response):
        if len(self.readings) <= 50:
            response.success = False
            response.message = f"only {len(self.readings)} of 50 readings so far"
            return response
        return super().calibrate(request, response)

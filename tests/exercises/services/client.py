"""A client in the form that tutorials show: a program of its own, beside the server of add.py."""

import sys

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class SumClient(Node):
    def __init__(self):
        super().__init__("sum_client")
        self.client = self.create_client(AddTwoInts, "add_two_ints")
        while not self.client.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("The service is not there yet, waiting...")
        self.request = AddTwoInts.Request()

    def send_request(self, a, b):
        self.request.a = a
        self.request.b = b
        self.future = self.client.call_async(self.request)
        rclpy.spin_until_future_complete(self, self.future)
        return self.future.result()


def main(args=None):
    rclpy.init(args=args)
    sum_client = SumClient()
    words = sys.argv[1:3] if len(sys.argv) > 2 and sys.argv[1].isdigit() else ["41", "1"]
    response = sum_client.send_request(*map(int, words))
    sum_client.get_logger().info(f"Result: {words[0]} + {words[1]} = {response.sum}")
    sum_client.destroy_node()
    rclpy.shutdown()

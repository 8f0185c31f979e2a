"""Programs that call a service many times in a row, as fast as the answers come."""

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.executors import SingleThreadedExecutor


def _client(node):
    client = node.create_client(AddTwoInts, "add")
    client.wait_for_service()
    return client


def spins_once_for_each():
    rclpy.init()
    node, executor = rclpy.create_node("caller"), SingleThreadedExecutor()
    executor.add_node(node)
    client, total = _client(node), 0
    for number in range(1000):
        future = client.call_async(AddTwoInts.Request(a=number, b=1))
        while not future.done():
            executor.spin_once_until_future_complete(future)
        total += future.result().sum
    print(total)


def spins_until_each_is_there():
    rclpy.init()
    node = rclpy.create_node("caller")
    client, total = _client(node), 0
    for number in range(1300):
        future = client.call_async(AddTwoInts.Request(a=number, b=1))
        rclpy.spin_until_future_complete(node, future)
        total += future.result().sum
    print(total)


def never_stops():
    rclpy.init()
    node = rclpy.create_node("caller")
    client = _client(node)
    while rclpy.ok():
        rclpy.spin_until_future_complete(node, client.call_async(AddTwoInts.Request()))

"""A service call, two actions and a topic go through the real rclpy, in a process of their own."""

import type_hashes


def test_a_service_responds(came_back):
    assert came_back["sum"] == 2**40 + 3


def test_an_action_gives_feedback_and_a_result(came_back):
    numbers = [0, 1, 1, 2, 3, 5, 8, 13]
    assert came_back["count"] == [True, numbers]
    assert came_back["steps"] == [numbers[:length] for length in range(3, 9)]


def test_an_action_can_be_canceled(came_back):
    assert came_back["canceled"] == [True, True]


def test_a_navigation_goal_goes_there_and_its_feedback_and_error_come_back(came_back):
    assert came_back["shown"] == [["map", 2.5]]
    assert came_back["drive"] == [True, 7, "no tree none.xml"]


def test_transforms_are_received(came_back):
    assert came_back["transforms"] == [["odom", "base_link", 1.25]] * 2


def test_the_network_sees_the_upstream_hash(came_back):
    assert came_back["tf hash"] == type_hashes.upstream()["tf2_msgs/msg/TFMessage"]

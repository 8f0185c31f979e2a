"""The demo nodes of ROS's tutorials, with upstream's names, topics and log lines."""

"""Reads launch files in YAML."""

from __future__ import annotations

from pathlib import Path

import yaml
from launch_ros import yaml_frontend as _nodes  # noqa: F401  (registers the actions for nodes)

from launch.launch_description import LaunchDescription
from launch.yaml_frontend import actions as _actions  # noqa: F401  (registers the actions)
from launch.yaml_frontend.entity import create_action


def read(path: str) -> LaunchDescription:
    """The launch description in a file. Raises RuntimeError, and the errors of wrong keys and values."""
    tree = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    if not isinstance(tree, dict) or list(tree) != ["launch"] or not isinstance(tree["launch"], list):
        raise RuntimeError(f"{path} is no launch file: it has to begin with `launch:`, and a list below it.")
    return LaunchDescription([create_action(child) for child in tree["launch"]])

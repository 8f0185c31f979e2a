"""Reads launch files in YAML and XML."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import yaml
from launch_ros import yaml_frontend as _nodes  # noqa: F401  (registers the actions for nodes)

from launch.launch_description import LaunchDescription
from launch.located import Located
from launch.yaml_frontend import actions as _actions  # noqa: F401  (registers the actions)
from launch.yaml_frontend.entity import create_action
from launch.yaml_frontend.xml_file import read_tree


class YamlLoader(yaml.SafeLoader):
    """Reads YAML into dictionaries that are `Located`."""

    def located(self, node: yaml.MappingNode) -> Iterator[Located]:
        """Construct a mapping."""
        found = Located()
        found.place = f"{self.name}, line {node.start_mark.line + 1}"
        yield found
        found.update(self.construct_mapping(node))


YamlLoader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, YamlLoader.located)


def read(path: str) -> LaunchDescription:
    """The launch description in a YAML file.

    Raises RuntimeError, and the errors of wrong keys and values, with file and line.
    """
    with Path(path).open(encoding="utf-8") as file:
        loader = YamlLoader(file)
        try:
            tree = loader.get_single_data()
        finally:
            loader.dispose()
    if not isinstance(tree, dict) or list(tree) != ["launch"] or not isinstance(tree["launch"], list):
        raise RuntimeError(
            f"{path} is not a launch file: it has to begin with `launch:`, with a list below it."
        )
    return LaunchDescription([create_action(child) for child in tree["launch"]])


def read_xml(path: str) -> LaunchDescription:
    """The launch description in an XML file. Raises as `read`."""
    return LaunchDescription([create_action(child) for child in read_tree(path)["launch"]])

"""Generates the URDF of a machine with joints, which ROS tools read from /robot_description."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from xml.etree import ElementTree as XML

from sim.world.machines.servo import THICKNESS, JointModel

EFFORT = 10.0
"""N m. URDF requires an effort limit; the simulated motors only have acceleration limits."""


def urdf(robot: str, names: Sequence[str], joints: Sequence[JointModel], links: Sequence[str]) -> str:
    """A robot with revolute joints, by name, and links in a row; lengths in meters, angles in radians.

    links: the names of the base, of each joint's link, and of a frame at the end of the last one.
    """
    root = XML.Element("robot", name=robot)
    XML.SubElement(root, "link", name=links[0])
    ends = [0.0, *(joint.length for joint in joints)]
    for name, joint, (parent, child), x in zip(names, joints, itertools.pairwise(links), ends, strict=False):
        _add_link(root, child, joint.length)
        one = _add_joint(root, name, "revolute", parent, child, x)
        XML.SubElement(one, "axis", xyz="0 0 1")
        limits = {"lower": joint.lower, "upper": joint.upper, "velocity": joint.max_velocity}
        XML.SubElement(
            one, "limit", {key: f"{value:g}" for key, value in limits.items()}, effort=f"{EFFORT:g}"
        )
    XML.SubElement(root, "link", name=links[-1])
    _add_joint(root, f"{links[-1]}_joint", "fixed", links[-2], links[-1], ends[-1])
    XML.indent(root)
    return XML.tostring(root, encoding="unicode")


def _add_link(root: XML.Element, name: str, length: float) -> None:
    visual = XML.SubElement(XML.SubElement(root, "link", name=name), "visual")
    XML.SubElement(visual, "origin", xyz=f"{length / 2:g} 0 0")
    size = f"{length + THICKNESS:g} {THICKNESS:g} {THICKNESS:g}"
    XML.SubElement(XML.SubElement(visual, "geometry"), "box", size=size)


def _add_joint(root: XML.Element, name: str, kind: str, parent: str, child: str, x: float) -> XML.Element:
    joint = XML.SubElement(root, "joint", name=name, type=kind)
    XML.SubElement(joint, "parent", link=parent)
    XML.SubElement(joint, "child", link=child)
    XML.SubElement(joint, "origin", xyz=f"{x:g} 0 0", rpy="0 0 0")
    return joint

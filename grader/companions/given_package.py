"""Writes a package that students are given, and changes its files."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

Folder = str | os.PathLike[str]
Fix = Callable[[str, str, str], None]
Move = Callable[[str, str], None]

XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email="you@example.org">you</maintainer>
  <license>Apache-2.0</license>

{depends}
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
MAIN = """\
def main():
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = {node}()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.commands.publish(Twist())  # zeros: stand still
        time.sleep(0.2)  # so that they get there
        node.destroy_node()
        rclpy.try_shutdown()
"""


def package_xml(name: str, description: str, *depends: str) -> str:
    """Return the package.xml of a package in Python."""
    lines = "".join(f"  <depend>{other}</depend>\n" for other in depends)
    return XML.format(name=name, description=description, depends=lines)


def stopping_main(node: str) -> str:
    """Return a main() that stops the robot on Ctrl-C and SIGTERM, for a node that publishes by `commands`."""
    return MAIN.format(node=node)


def write_package(workspace: Folder, files: Mapping[str, str]) -> None:
    """Write the files of a package into a workspace. Existing files are overwritten.

    files: path below src/ to text.
    """
    for path, text in files.items():
        file = Path(workspace) / "src" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def fix_text(folder: Path, file: str, old: str, new: str) -> None:
    """Replace a text in a file of a package's folder.

    Raises ValueError where the file has no `old`, or more than one, and FileNotFoundError for no file.
    """
    path = folder / file
    text = path.read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"{file} has {text.count(old)} times {old!r}: give a text that it has once.")
    path.write_text(text.replace(old, new), encoding="utf-8")


def move_file(folder: Path, old: str, new: str) -> None:
    """Move a file of a package's folder, and make the folders that the new path needs.

    Raises FileNotFoundError where there is no `old`, and FileExistsError where there is something at `new`.
    """
    if not (folder / old).is_file():
        paths = sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
        raise FileNotFoundError(f"There is no file {old} in {folder.name}: its files are {', '.join(paths)}.")
    if (folder / new).exists():
        raise FileExistsError(f"There is already {new} in {folder.name}: move {old} to another path.")
    (folder / new).parent.mkdir(parents=True, exist_ok=True)
    (folder / old).rename(folder / new)

"""The package patrol as it should be, the faults that it may have, and the correction of the last one.

Students get the package with six of the faults, and nothing of this module.
"""

from __future__ import annotations

from collections.abc import Mapping

from grader.exercises.launching.patrol.patrol_package import FILES as BROKEN

# The file, the right text, and the wrong one. Each shows when those before it are fixed.
FAULTS = (
    ("patrol/package.xml", "</maintainer>", ""),
    ("patrol/package.xml", "  <depend>geometry_msgs</depend>\n", ""),
    ("patrol/setup.py", "find_packages(exclude=['test'])", "[]"),
    ("patrol/setup.py", "['package.xml']),", "['package.xml'])"),
    ("patrol/setup.py", "'patrol = patrol.driver:main'", "'patrol = patrol.driver:mian'"),
    ("patrol/setup.py", "['resource/' + package_name]", "['resource/partol']"),
    ("patrol/setup.py", "        ('share/' + package_name + '/launch', glob('launch/*')),\n", ""),
    ("patrol/setup.cfg", "install_scripts=$base/lib/patrol", "install_scripts=$base/bin"),
    ("patrol/patrol/driver.py", "from patrol.speeds import", "from speeds import"),
    ("patrol/launch/patrol.launch.py", 'executable="patrol"', 'executable="driver"'),
    ("patrol/config/patrol.yaml", "ros__parameters", "ros_parameters"),
    ("patrol/config/patrol.yaml", "speed: 0.15", "speed: 1"),
)
GIVEN = 0, 3, 4, 6, 7, 10  # those of students


def repaired() -> dict[str, str]:
    """Return the files of the package without faults: path below src/ to text."""
    files = dict(BROKEN)
    for path, right, wrong in (FAULTS[number] for number in GIVEN if FAULTS[number][2]):
        files[path] = files[path].replace(wrong, right)
    files["patrol/package.xml"] = files["patrol/package.xml"].replace(">you\n", ">you</maintainer>\n")
    line = "['package.xml']),\n"
    files["patrol/setup.py"] = files["patrol/setup.py"].replace(line, line + FAULTS[6][1])
    return files


FILES = repaired()


def with_one_fault_less(sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the file with the last fault that is left, corrected; nothing for other numbers of faults."""
    left = [fault for fault in FAULTS if _is_left(sources, *fault)]
    if len(left) != 1:
        return {}
    path, right, wrong = left[0]
    text = sources[path].decode("utf-8", "replace")
    if wrong:
        return {path: text.replace(wrong, right).encode()}
    before = FILES[path].partition(right)[0].rpartition("\n  ")[2]
    return {path: text.replace(before, before + right, 1).encode()}


def _is_left(sources: Mapping[str, bytes], path: str, right: str, wrong: str) -> bool:
    text = sources.get(path, b"").decode("utf-8", "replace")
    return bool(text) and right not in text and (not wrong or wrong in text)

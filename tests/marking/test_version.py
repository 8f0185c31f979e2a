import re

from grader.marking.version import code_version, versions


def test_the_version_is_that_of_the_code():
    first = code_version()
    code_version.cache_clear()
    assert code_version() == first
    assert len(first) == 64


def test_versions_name_all_that_a_grade_depends_on():
    found = versions()
    assert list(found) == ["course", "Python", "ros-jazzy-rclpy", "numpy", "pymunk", "ipython", "matplotlib"]
    assert found["course"] == code_version()[:12]
    assert re.fullmatch(r"3\.1[1234]", found["Python"])

import pytest

from sim.ros2 import absent_colcon
from sim.ros2.absent_colcon import SENTENCE, missing_colcon


@pytest.mark.parametrize(
    "cell", ["!cd ws && colcon build", "%%bash\ncd ws\ncolcon test", "x = 1\n!colcon build"]
)
def test_a_cell_that_starts_colcon_says_that_it_is_absent_and_what_to_do(cell, monkeypatch):
    monkeypatch.setattr(absent_colcon.shutil, "which", lambda name: None)
    assert missing_colcon(cell) == SENTENCE
    monkeypatch.setattr(absent_colcon.shutil, "which", lambda name: "/usr/bin/colcon")
    assert missing_colcon(cell) == ""


@pytest.mark.parametrize("cell", ["predict('Does colcon build fail?', a='yes')", "!ls", "# colcon build"])
def test_a_cell_that_only_names_it_says_nothing(cell, monkeypatch):
    monkeypatch.setattr(absent_colcon.shutil, "which", lambda name: None)
    assert missing_colcon(cell) == ""

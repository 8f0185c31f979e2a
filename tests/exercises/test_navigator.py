"""Score tables of 06_navigator: a page for each exercise in tests/exercises/navigator/."""

from grader.exercises import navigator
from tests.exercises.assignment import Assignment


class TestNavigator(Assignment):
    folder = "06_navigator"
    package = navigator

    def test_a_tutorials_listing_with_a_fixed_goal_is_right_as_it_is(self):
        assert "tutorial_main" in self.right("drive")

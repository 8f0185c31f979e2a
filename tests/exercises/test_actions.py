"""Score tables of 04_actions: a page for each exercise in tests/exercises/actions/."""

from grader.exercises import actions
from tests.exercises.assignment import Assignment
from tests.exercises.score_tables import executed


class TestActions(Assignment):
    folder = "04_actions"
    package = actions

    def test_the_lesson_shows_what_it_speaks_of(self):
        cells = executed("course", f"{self.folder}/lesson") | executed("course", f"{self.folder}/driving")
        assert {name: cell.problems for name, cell in cells.items() if cell.problems} == {}
        assert cells["why-run"].text.endswith("requested at 1.0 s, response at 7.0 s\n")
        assert cells["forget-run"].text.endswith("['accepted', 'executing', 'aborted']\n")
        assert "lost: True" in cells["lost-run"].text
        assert cells["reject-run"].text.endswith("[(1.0, 'rejected')]\n")
        assert "did not return a GoalResponse" in cells["reject-true"].text
        for deaf in ("deaf-run", "threads-group-run"):
            assert cells[deaf].text.endswith("5.5 s  succeeded\n5.5 s  cancel rejected\n")
        for received in ("cancel-run", "threads-run"):
            assert "status 5, result [0, 1, 1, 2, 3]" in cells[received].text
        assert cells["drive-blind-run"].text == "the robot is at x = 2.76 m, and the goal is executing\n"
        assert "canceled after 0.98 m" in cells["honest-cancel"].text
        assert "DishonestServer: 0.22 m further" in cells["dishonest-run"].text
        assert "status 6: only 0.50 m in 5 s" in cells["limit-run"].text
        assert "succeeded at 4.04 rad" in cells["spin-run"].text
        assert "canceled after 0.24 m" in cells["patience-run"].text
        assert cells["levels-run"].text.count(" m\n") == 4
        assert "status 6: replaced after 0.78 m" in cells["preempt-run"].text
        assert cells["together-run"].text.count(": done\n") == 4

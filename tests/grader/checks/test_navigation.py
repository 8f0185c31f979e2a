import pytest

from grader import Missed
from grader.checks.navigation import goals_from_course
from tests.grader.recordings import recording


def test_without_a_goal_the_client_found_no_server():
    with pytest.raises(Missed) as caught:
        goals_from_course(recording())
    assert caught.value.expected == "a goal that is taken"
    assert caught.value.saw == "no server was there when the client looked for one"

import pytest

from grader import Missed
from grader.checks import has_timer, named, no_errors
from grader.checks.motion import last_pose
from sim import run
from sim.evidence import Graph, TimerInfo
from tests.sim.recordings import recording
from tests.students import misfits, mistakes


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def test_no_errors_tells_the_first_error():
    no_errors(run(misfits.Talker, seconds=2, quiet=True))
    miss = missed(no_errors, run(mistakes.DividesByZero, seconds=2, quiet=True))
    assert miss.expected == "no error"
    assert miss.saw.startswith("ZeroDivisionError: division by zero (in DividesByZero.tick, line ")


def test_named_finds_the_node():
    talker = run(misfits.Talker, seconds=1, quiet=True)
    named(talker, "/talker")
    miss = missed(named, talker, "/talkers")
    assert (miss.expected, miss.saw) == ("a node called /talkers", "/talker")
    assert miss.hint == "Is /talker a typo? Did you mean /talkers?"
    assert miss.typo == ("__node", "talkers")
    assert missed(named, talker, "/camera").typo is None
    assert missed(named, recording(graph=Graph(["/eye", "/ear"])), "/talker").saw == "/eye, /ear"
    assert missed(named, talker, "/camera").hint == "Set the node's name with super().__init__('name')."
    assert missed(named, recording(), "/talker").saw == "no node"


def test_has_timer_finds_the_period():
    talker = run(misfits.Talker, seconds=1, quiet=True)
    assert [timer.callback for timer in has_timer(talker, 1.0)] == ["Talker.tick"]
    miss = missed(has_timer, talker, 0.5)
    assert (miss.expected, miss.saw) == ("a timer every 0.5 s", "every 1 s")
    assert miss.hint == "self.create_timer(0.5, self.callback) calls a method every 0.5 s."
    assert missed(has_timer, recording(), 0.5).saw == "no timer"


def test_a_period_may_differ_by_a_thousandth_or_as_much_as_is_said():
    run = recording(graph=Graph(["/heart"], timers=[TimerInfo("/heart", 2.0, "beat"), TimerInfo("/heart", 0.5, "look")]))
    assert [timer.callback for timer in has_timer(run, 2.0019)] == ["beat"]
    assert missed(has_timer, run, 2.0022).saw == "every 2 s, every 0.5 s"
    assert [timer.callback for timer in has_timer(run, 0.52, tolerance=0.05)] == ["look"]


def test_last_pose_of_a_robot_is_where_it_ends():
    end = last_pose(run(misfits.Talker, world="yard", seconds=1, quiet=True))
    assert (end.stamp, end.x, end.y) == (pytest.approx(1.0), 0.0, 0.0)

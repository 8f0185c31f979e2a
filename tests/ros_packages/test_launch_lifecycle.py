"""What LifecycleNode, its events and its handler refuse, and with what words."""

import textwrap

import pytest
from launch import LaunchContext
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import LifecycleNode, LifecycleTransition, Node
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import lifecycle, matches_node_name
from launch_ros.events.lifecycle import ChangeState, StateTransition
from lifecycle_msgs.msg import State, Transition, TransitionEvent

from tests.ros_packages.test_launch import fails_with, log_of


def lamp(**more):
    return LifecycleNode(**({"executable": "true", "name": "lamp", "namespace": "hall"} | more))


def transition(start_state, goal_state, action=None):
    message = TransitionEvent(
        timestamp=5, start_state=State(label=start_state), goal_state=State(label=goal_state)
    )
    return StateTransition(action=action, msg=message)


@pytest.mark.parametrize("missing", ["name", "namespace"])
def test_name_and_namespace_are_required(missing):
    given = {"executable": "true", "name": "lamp", "namespace": "hall"}
    del given[missing]
    with pytest.raises(TypeError, match=f"missing 1 required keyword-only argument: '{missing}'"):
        LifecycleNode(**given)


def test_a_lifecycle_node_knows_what_it_is():
    node = lamp(autostart=True)
    assert (node.is_lifecycle_node, node.node_autostart) == (True, True)
    assert node.get_lifecycle_event_manager() is None
    assert not Node(executable="true").is_lifecycle_node


def test_transitions_and_states_have_upstreams_names():
    assert ChangeState.valid_transitions[Transition.TRANSITION_ACTIVATE] == "TRANSITION_ACTIVATE"
    assert ChangeState.valid_states[State.TRANSITION_STATE_CLEANINGUP] == "TRANSITION_STATE_CLEANINGUP"
    assert LifecycleTransition.transition_targets[Transition.TRANSITION_CLEANUP] == {
        "start_state": "cleaningup",
        "goal_state": "unconfigured",
    }


def test_a_transition_event_has_what_its_message_says():
    node = lamp()
    event = transition("configuring", "inactive", node)
    assert (event.action, event.timestamp, event.transition) == (node, 5, "")
    assert (event.start_state, event.goal_state) == ("configuring", "inactive")
    assert event.msg.goal_state.label == "inactive"


def test_a_handler_matches_what_it_is_given():
    node = lamp()
    event = transition("configuring", "inactive", node)
    assert OnStateTransition(entities=[]).matches(event)
    assert OnStateTransition(entities=[], target_lifecycle_node=node, goal_state="inactive").matches(event)
    assert not OnStateTransition(entities=[], target_lifecycle_node=lamp()).matches(event)
    assert not OnStateTransition(entities=[], start_state="activating").matches(event)
    assert not OnStateTransition(entities=[], transition="configure").matches(event)
    assert not OnStateTransition(entities=[]).matches(
        ChangeState(lifecycle_node_matcher=bool, transition_id=1)
    )
    assert OnStateTransition(entities=[], goal_state="active", matcher=lambda _: True).matches(event)


@pytest.mark.parametrize(
    ("target", "what"),
    [(Node(executable="true"), "lifecycle-enabled node"), ("lamp", "node type")],
)
def test_a_handler_refuses_what_has_no_lifecycle(target, what):
    with pytest.raises(RuntimeError) as refused:
        OnStateTransition(target_lifecycle_node=target, entities=[])
    assert str(refused.value) == (
        'OnStateTransition requires a "LifecycleNode" action as the target, '
        f"target_lifecycle_node is not a {what}."
    )


def test_an_unknown_transition_is_refused():
    with pytest.raises(ValueError) as refused:
        ChangeState(lifecycle_node_matcher=bool, transition_id=42)
    assert str(refused.value) == (
        "given transition_id of '42', expected one of {TRANSITION_CREATE: 0, TRANSITION_CONFIGURE: 1, "
        "TRANSITION_CLEANUP: 2, TRANSITION_ACTIVATE: 3, TRANSITION_DEACTIVATE: 4, "
        "TRANSITION_UNCONFIGURED_SHUTDOWN: 5, TRANSITION_INACTIVE_SHUTDOWN: 6, "
        "TRANSITION_ACTIVE_SHUTDOWN: 7, TRANSITION_DESTROY: 8}"
    )


@pytest.mark.parametrize(
    ("names", "ids", "words"),
    [([], [1], "No lifecycle_node_names provided."), (["lamp"], [], "No transition_ids provided.")],
)
def test_a_sequence_of_transitions_needs_nodes_and_transitions(names, ids, words):
    with pytest.raises(ValueError) as refused:
        LifecycleTransition(lifecycle_node_names=names, transition_ids=ids)
    assert str(refused.value) == words


@pytest.mark.parametrize(
    ("number", "words"),
    [
        ("configure", "expected integer for lifecycle transition, got configure"),
        (0, "lifecycle transition 0 has no goal to wait for: there are 1, 2, 3, 4, 5, 6, 7"),
        ("9", f"given transition_id of '9', expected one of {{{ChangeState.valid_transitions[0]}: 0"),
    ],
)
def test_a_sequence_refuses_what_is_no_transition(number, words):
    with pytest.raises(ValueError) as refused:
        LifecycleTransition(lifecycle_node_names=["lamp"], transition_ids=[number]).execute(LaunchContext())
    assert str(refused.value).startswith(words)


def test_a_matcher_by_name_adds_the_first_slash():
    node = lamp()
    node._expand_name(LaunchContext())
    assert matches_node_name("hall/lamp")(node)
    assert matches_node_name("/hall/lamp")(node)
    assert not matches_node_name("lamp")(node)
    with pytest.warns(UserWarning) as warned:
        assert lifecycle.matches_node_name("hall/lamp")(node)
    assert str(warned[0].message) == (
        "'matches_node_name' has been moved into the 'launch.events' module and will be removed from the "
        "'lifecycle' module in the future"
    )


def of_xml(tmp_path, entity):
    file = tmp_path / "some.launch.xml"
    file.write_text(textwrap.dedent(f"<launch>{entity}</launch>"))
    return log_of(IncludeLaunchDescription(str(file)), status=1), f"{file}, line 1"


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ('name="a"', "Can not find attribute 'namespace' in Entity 'lifecycle_node'"),
        ('namespace=""', "Can not find attribute 'name' in Entity 'lifecycle_node'"),
        ('name="a" namespace="" autostrt="1"', "Unexpected key(s) found in `lifecycle_node`: {'autostrt'}"),
    ],
)
def test_xml_refuses_a_lifecycle_node_with_other_attributes(tmp_path, attributes, words):
    lines, place = of_xml(tmp_path, f'<lifecycle_node exec="true" {attributes}/>')
    (line,) = lines
    assert words in line
    assert place in line


def test_no_name_is_refused():
    (line,) = fails_with("node_name unexpectedly incomplete for lifecycle node")
    assert log_of(lamp(name=None), status=1)[-1] == line

"""Launch files in XML say the same as those in YAML, and name the line of a mistake."""

import textwrap

import pytest
from launch.actions import IncludeLaunchDescription
from launch.launch_context import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch_ros.parameters import evaluate_parameter_dict

from tests.ros_packages.test_launch import fails_with, log_of, logged

SAME = r"""
<!-- all entities that have no process -->
<launch>
  <arg name="robot" default="anna" description="its name"><choice value="anna"/><choice value="berta"/></arg>
  <let name="topic" value="/$(var robot)/scan"/>
  <log message="$(var topic) $(var none '-') $(eval '1 + $(eval 2)') $(equals a a)"/>
  <log message="$(not-equals a b) $(env NONE_OF_TEST no)" if="$(equals $(var robot) berta)"/>
  <log message="not berta" unless="$(equals $(var robot) berta)"/>
  <group>
    <push_ros_namespace namespace="one"/>
    <log message="$(var ros_namespace)"/>
  </group>
  <group scoped="false">
    <keep name="kept" value="yes"/>
    <set_env name="X_OF_XML" value="x"/>
  </group>
  <log message="$(var ros_namespace none) $(var kept) $(env X_OF_XML) $(command 'echo hi')"/>
  <timer period="0.01">
    <shutdown reason="so"/>
  </timer>
</launch>
"""


def of_xml(tmp_path, text, status=0, name="some.launch.xml", **arguments):
    file = tmp_path / name
    file.write_text(textwrap.dedent(text).strip())
    return log_of(IncludeLaunchDescription(str(file), launch_arguments=arguments.items()), status=status)


@pytest.mark.parametrize("name", ["some.launch.xml", "some.launch"])
def test_xml_says_the_same(tmp_path, name):
    assert of_xml(tmp_path, SAME, name=name) == [
        logged("/anna/scan - 3 true"),
        logged("not berta"),
        logged("/one"),
        logged("none yes x hi\n"),
    ]


def parameters_of(tmp_path, inside):
    file = tmp_path / "node.launch.xml"
    file.write_text(f'<launch><node exec="true" name="n">{inside}</node></launch>')
    (node,) = AnyLaunchDescriptionSource(str(file)).get_launch_description(LaunchContext()).entities
    return [evaluate_parameter_dict(LaunchContext(), given) for given in node._Node__parameters]


@pytest.mark.parametrize(
    ("attributes", "value"),
    [
        ('value="3"', 3),
        ('value="3.5"', 3.5),
        ('value="true"', True),
        ('value="[1, 2]"', [1, 2]),
        ('value="1;2" value-sep=";"', [1, 2]),
        ('value="a, b: c"', "a, b: c"),
        ('value="2025-01-01"', "2025-01-01"),
        ('value=""', ""),
        ('value="3" type="str"', "3"),
        ('value="3" type="float"', 3.0),
    ],
)
def test_a_parameter_has_the_type_that_its_text_looks_like(tmp_path, attributes, value):
    assert parameters_of(tmp_path, f'<param name="p" {attributes}/>') == [{"p": value}]


def test_parameters_are_nested_as_in_yaml(tmp_path):
    inside = '<param name="a"><param name="b" value="1"/><param name="c" value="$(eval 1+1)"/></param>'
    assert parameters_of(tmp_path, inside) == [{"a.b": 1, "a.c": 2}]


@pytest.mark.parametrize(
    ("text", "words", "line"),
    [
        ("<nod/>", "Unrecognized entity of the type: nod. There are ", 2),
        ("\n<node pkg='a'/>", "Can not find attribute 'exec' in Entity 'node'", 3),
        (
            "<log message='a' mesage='b'/>",
            "Unexpected key(s) found in `log`: {'mesage'}",
            2,
        ),
        (
            "<group>\n<log message='$(var)'/>\n</group>",
            "var substitution expects 1 or 2",
            3,
        ),
        (
            "<group scoped='perhaps'/>",
            "Attribute 'scoped' of Entity 'group' has to be true",
            2,
        ),
        (
            "<node exec='a' respawn_delay='x'/>",
            "Attribute 'respawn_delay' of Entity 'node' has",
            2,
        ),
        (
            "<log message='$(var none)'/>",
            "launch configuration 'none' does not exist",
            2,
        ),
        ("<group>", "mismatched tag", "3, column 3"),
        (
            "<arg name='a'>b</arg>",
            "<arg> contains the text 'b': a value is an attribute",
            2,
        ),
    ],
)
def test_a_mistake_is_named_with_its_file_and_line(tmp_path, text, words, line):
    (found,) = of_xml(tmp_path, f"<launch>\n{text}\n</launch>", status=1)
    assert found.startswith(fails_with(words)[0])
    assert found.endswith(f"({tmp_path}/some.launch.xml, line {line})")


def test_the_root_is_launch(tmp_path):
    assert of_xml(tmp_path, "<robot/>", status=1) == fails_with(
        f"{tmp_path}/some.launch.xml is not a launch file: its root has to be <launch>, but is <robot>."
    )


def test_a_mistake_in_yaml_has_its_line_too(tmp_path):
    file = tmp_path / "some.launch.yaml"
    file.write_text("launch:\n- log: {message: a}\n- nod: {}\n")
    (line,) = log_of(IncludeLaunchDescription(str(file)), status=1)
    assert line.endswith(f"({file}, line 3)")


def test_a_timer_whose_scope_has_ended_names_its_line_in_python(tmp_path):
    inner = tmp_path / "inner.launch.py"
    inner.write_text(
        textwrap.dedent("""
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument, LogInfo, TimerAction
        from launch.substitutions import LaunchConfiguration

        def generate_launch_description():
            return LaunchDescription([
                DeclareLaunchArgument("robot", default_value="anna"),
                TimerAction(period=0.01, actions=[
                    LogInfo(msg=LaunchConfiguration("robot")),
                ]),
            ])
        """)
    )
    (line,) = of_xml(tmp_path, f"<launch><group><include file='{inner}'/></group></launch>", status=1)
    assert line == fails_with(f"launch configuration 'robot' does not exist ({inner}, line 10)")[0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    {
        "<node pkg='a' type='b'/>": "`type` of `node` is of ROS 1: ROS 2 has exec.",
        "<node exec='a' required='true'/>": '`required` of `node` is of ROS 1: ROS 2 has on_exit="shutdown".',
        "<group ns='a'/>": "`ns` of `group` is of ROS 1: ROS 2 has a push_ros_namespace entity in the group.",
        "<arg name='a' value='b'/>": "`value` of `arg` is of ROS 1: ROS 2 has let for a fixed value, or "
        "default for one that can be changed.",
        "<param name='a' value='b'/>": "`param` belongs in a node in ROS 2; set_parameter sets one for all "
        "nodes of its group.",
        "<rosparam file='a'/>": '`rosparam` is of ROS 1: ROS 2 has <param from="FILE"/> in a node.',
        "<log message='$(find a)/b'/>": "$(find ...) is of ROS 1: ROS 2 has $(find-pkg-share ...).",
        "<log message='$(arg a)'/>": "$(arg ...) is of ROS 1: ROS 2 has $(var ...).",
        "<node_container pkg='a' exec='b'/>": "`node_container` loads C++ components, which are not built "
        "here: start each node with a node entity.",
    }.items(),
)
def test_what_is_of_ros_1_or_of_cpp_is_named_with_what_to_write(tmp_path, text, sentence):
    (found,) = of_xml(tmp_path, f"<launch>\n{text}\n</launch>", status=1)
    assert found == fails_with(f"{sentence} ({tmp_path}/some.launch.xml, line 2)")[0]


@pytest.mark.parametrize("end", ["xml", "yaml", "py"])
def test_a_misspelt_name_of_an_included_file_is_recognized(tmp_path, end):
    (tmp_path / f"child.launch.{end}").write_text("")
    include = f"<include file='{tmp_path}/chlid.launch.{end}'/>"
    (found,) = of_xml(tmp_path, f"<launch>\n{include}\n</launch>", status=1)
    lost = f"[Errno 2] No such file or directory: '{tmp_path}/chlid.launch.{end}'"
    lost += f". Did you mean 'child.launch.{end}'?"
    assert found == fails_with(f"{lost} ({tmp_path}/some.launch.xml, line 2)")[0]

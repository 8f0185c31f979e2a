from xml.etree import ElementTree as XML

from sim.world.machines import ArmModel, JointModel, urdf

ARM = ArmModel(JointModel(-2.0, 2.5, length=0.6, max_velocity=1.5), JointModel(-0.1, 2.2, length=0.3))
NAMES, LINKS = ["shoulder_joint", "elbow_joint"], ["base_link", "upper_arm", "forearm", "tip"]


def test_joints_have_their_limits_and_connect_the_links_in_a_row():
    robot = XML.fromstring(urdf("arm", NAMES, ARM.joints, LINKS))
    assert (robot.tag, robot.get("name")) == ("robot", "arm")
    assert [link.get("name") for link in robot.iter("link") if link.get("name")] == LINKS
    rows = [
        (joint.get("name"), joint.get("type"), joint.find("parent").get("link"),
         joint.find("child").get("link"), joint.find("origin").get("xyz"))
        for joint in robot.findall("joint")
    ]  # fmt: skip
    assert rows == [
        ("shoulder_joint", "revolute", "base_link", "upper_arm", "0 0 0"),
        ("elbow_joint", "revolute", "upper_arm", "forearm", "0.6 0 0"),
        ("tip_joint", "fixed", "forearm", "tip", "0.3 0 0"),
    ]
    limits = [joint.find("limit").attrib for joint in robot.findall("joint")[:2]]
    assert limits == [
        {"lower": "-2", "upper": "2.5", "velocity": "1.5", "effort": "10"},
        {"lower": "-0.1", "upper": "2.2", "velocity": "1", "effort": "10"},
    ]


def test_a_link_is_drawn_from_joint_to_joint():
    robot = XML.fromstring(urdf("arm", NAMES, ARM.joints, LINKS))
    upper_arm = robot.findall("link")[1].find("visual")
    assert upper_arm.find("origin").get("xyz") == "0.3 0 0"
    assert upper_arm.find("geometry").find("box").get("size") == "0.66 0.06 0.06"

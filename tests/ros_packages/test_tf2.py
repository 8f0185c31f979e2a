"""The buffer against numpy: composition, inverse, interpolation; and its refusals in upstream's words."""

import math

import numpy as np
import pytest
import tf2_geometry_msgs
import tf2_ros
import tf_transformations as tft
from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PolygonStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Vector3,
    Vector3Stamped,
)
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_ros import Buffer, BufferInterface

SEEDS = range(20)


def random_matrix(draw: np.random.Generator) -> np.ndarray:
    matrix = tft.random_rotation_matrix(draw.random(3))
    matrix[:3, 3] = draw.uniform(-5, 5, 3)
    return matrix


def message(parent: str, child: str, matrix: np.ndarray, seconds: float = 1.0) -> TransformStamped:
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id, sent.header.stamp = parent, Time(nanoseconds=round(seconds * 1e9)).to_msg()
    sent.transform.translation = Vector3(**dict(zip("xyz", map(float, matrix[:3, 3]), strict=True)))
    turn = map(float, tft.quaternion_from_matrix(matrix))
    sent.transform.rotation = Quaternion(**dict(zip("xyzw", turn, strict=True)))
    return sent


def matrix_of(sent: TransformStamped) -> np.ndarray:
    shift, turn = sent.transform.translation, sent.transform.rotation
    matrix = tft.quaternion_matrix([turn.x, turn.y, turn.z, turn.w])
    matrix[:3, 3] = shift.x, shift.y, shift.z
    return matrix


def shifted(x: float, yaw: float = 0.0) -> np.ndarray:
    matrix = tft.euler_matrix(0, 0, yaw)
    matrix[0, 3] = x
    return matrix


def buffer_of(*messages: TransformStamped, static: tuple = (), **options) -> Buffer:
    buffer = Buffer(**options)
    for one in messages:
        buffer.set_transform(one, "test")
    for one in static:
        buffer.set_transform_static(one, "test")
    return buffer


@pytest.mark.parametrize("seed", SEEDS)
def test_a_way_through_the_tree_is_the_product_of_its_matrices(seed):
    draw = np.random.default_rng(seed)
    a, b, c, d = (random_matrix(draw) for _ in range(4))
    #      map -a-> odom -b-> base -c-> scan, and map -d-> dock
    buffer = buffer_of(
        message("map", "odom", a),
        message("odom", "base", b),
        message("map", "dock", d),
        static=[message("base", "scan", c)],
    )
    whole = matrix_of(buffer.lookup_transform("map", "scan", Time()))
    np.testing.assert_allclose(whole, a @ b @ c, atol=1e-12)
    back = matrix_of(buffer.lookup_transform("scan", "map", Time()))
    np.testing.assert_allclose(back, np.linalg.inv(a @ b @ c), atol=1e-12)
    across = matrix_of(buffer.lookup_transform("dock", "base", Time()))
    np.testing.assert_allclose(across, np.linalg.inv(d) @ a @ b, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_between_two_moments_it_goes_straight_and_turns_evenly(seed):
    draw = np.random.default_rng(seed)
    begin, end = random_matrix(draw), random_matrix(draw)
    ratio = float(draw.random())
    buffer = buffer_of(message("a", "b", begin, 1.0), message("a", "b", end, 3.0))
    found = matrix_of(buffer.lookup_transform("a", "b", Time(nanoseconds=round((1 + 2 * ratio) * 1e9))))
    np.testing.assert_allclose(found[:3, 3], (1 - ratio) * begin[:3, 3] + ratio * end[:3, 3], atol=1e-8)
    angle, axis, _ = tft.rotation_from_matrix(_turn(np.linalg.inv(begin) @ end))
    expected = begin[:3, :3] @ tft.rotation_matrix(ratio * angle, axis)[:3, :3]
    np.testing.assert_allclose(found[:3, :3], expected, atol=1e-7)
    even = tft.quaternion_slerp(tft.quaternion_from_matrix(begin), tft.quaternion_from_matrix(end), ratio)
    np.testing.assert_allclose(tft.quaternion_matrix(even)[:3, :3], expected, atol=1e-9)


def _turn(matrix: np.ndarray) -> np.ndarray:
    only = np.eye(4)
    only[:3, :3] = matrix[:3, :3]
    return only


def test_two_moments_are_joined_by_a_frame_that_stands_still():
    moves = [message("world", "robot", shifted(float(second)), second) for second in (1, 2, 3)]
    buffer = buffer_of(*moves)
    at = [Time(seconds=second) for second in range(4)]
    found = buffer.lookup_transform_full("robot", at[1], "robot", at[3], "world")
    assert found.transform.translation.x == pytest.approx(2.0)  # it has gone 2 m since
    assert (found.header.frame_id, found.child_frame_id, found.header.stamp.sec) == ("robot", "robot", 1)
    assert buffer.can_transform_full("robot", at[1], "robot", at[3], "world")
    why = buffer.can_transform_full("robot", at[1], "robot", at[3], "moon", return_debug_tuple=True)
    assert why == (
        False,
        'Invalid frame ID "moon" passed to canTransform argument fixed_frame - frame does not exist',
    )


def test_the_newest_time_is_the_newest_that_all_on_the_way_have():
    buffer = buffer_of(
        *(message("map", "odom", shifted(1), second) for second in (1.0, 5.0)),
        *(message("odom", "base", shifted(1), second) for second in (1.0, 4.5)),
        static=[message("base", "scan", shifted(1))],
    )
    assert buffer.get_latest_common_time("map", "scan").nanoseconds == 4_500_000_000
    assert buffer.lookup_transform("map", "scan", Time()).header.stamp.nanosec == 500_000_000
    assert buffer.lookup_transform("base", "scan", Time()).header.stamp.sec == 0  # holds for all times
    assert buffer.lookup_transform("odom", "odom", Time()).header.stamp.sec == 5


REFUSALS = {
    "unknown": (
        ("map", "bse", 1),
        "LookupException",
        '"bse" passed to lookupTransform argument source_frame does not exist. ',
    ),
    "empty": (
        ("", "base", 1),
        "InvalidArgumentException",
        'Invalid argument "" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot be empty',
    ),
    "slash": (
        ("/map", "base", 1),
        "InvalidArgumentException",
        "Invalid argument \"/map\" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot start with a '/'",
    ),
    "future": (
        ("map", "base", 9),
        "ExtrapolationException",
        "Lookup would require extrapolation into the future.  Requested time 9.000000 but the latest data is at time 2.000000, when looking up transform from frame [base] to frame [map]",
    ),
    "past": (
        ("base", "map", 0.5),
        "ExtrapolationException",
        "Lookup would require extrapolation into the past.  Requested time 0.500000 but the earliest data is at time 1.000000, when looking up transform from frame [map] to frame [base]",
    ),
    "one": (
        ("map", "dock", 2),
        "ExtrapolationException",
        "Lookup would require extrapolation at time 2.000000, but only time 1.000000 is in the buffer, when looking up transform from frame [dock] to frame [map]",
    ),
    "island": (
        ("map", "tree", 1),
        "ConnectivityException",
        "Could not find a connection between 'map' and 'tree' because they are not part of the same tree.Tf has two or more unconnected trees.",
    ),
    "island, newest": (
        ("map", "tree", 0),
        "ConnectivityException",
        "Could not find a connection between 'map' and 'tree' because they are not part of the same tree.Tf has two or more unconnected trees.",
    ),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_what_cant_be_had_is_refused_in_upstreams_words(case):
    (target, source, seconds), kind, words = REFUSALS[case]
    buffer = buffer_of(
        message("map", "base", shifted(1), 1),
        message("map", "base", shifted(2), 2),
        message("map", "dock", shifted(1), 1),
        message("island", "tree", shifted(1), 1),
    )
    time = Time(nanoseconds=round(seconds * 1e9))
    with pytest.raises(tf2_ros.TransformException) as refusal:
        buffer.lookup_transform(target, source, time)
    assert (type(refusal.value).__name__, str(refusal.value)) == (kind, words)
    assert buffer.can_transform(target, source, time) is False


def test_a_circle_of_frames_is_no_tree():
    buffer = buffer_of(
        message("a", "b", shifted(1)), message("b", "a", shifted(1)), message("c", "d", shifted(1))
    )
    circle = "The tf tree is invalid because it contains a loop.\nFrame b exists with parent a.\n"
    for time in (Time(), Time(seconds=1)):
        with pytest.raises(tf2_ros.LookupException) as refusal:
            buffer.lookup_transform("d", "a", time)
        assert str(refusal.value).startswith(circle)


IGNORED = {
    "self": (
        message("a", "a", shifted(1)),
        'TF_SELF_TRANSFORM: Ignoring transform from authority "me" with frame_id and  child_frame_id "a" because they are the same',
    ),
    "no child": (
        message("a", "", shifted(1)),
        'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "me" because child_frame_id not set ',
    ),
    "no parent": (
        message("", "b", shifted(1)),
        'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "b"  from authority "me" because frame_id not set',
    ),
    "nan": (
        message("a", "b", shifted(math.nan)),
        'TF_NAN_INPUT: Ignoring transform for child_frame_id "b" from authority "me" because of a nan value in the transform (nan 0.000000 0.000000) (0.000000 0.000000 0.000000 1.000000)',
    ),
    "no turn": (TransformStamped(child_frame_id="b", transform=TransformStamped().transform), None),
}
IGNORED["no turn"][0].header.frame_id = "a"
IGNORED["no turn"][0].transform.rotation.w = 2.0
IGNORED["no turn"] = (
    IGNORED["no turn"][0],
    'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "b" from authority "me" because of an invalid quaternion in the transform (0.000000 0.000000 0.000000 2.000000)',
)


@pytest.mark.parametrize("case", IGNORED)
def test_a_transform_that_cant_be_is_logged_and_left_out(case, capfd):
    sent, words = IGNORED[case]
    buffer = Buffer()
    buffer.set_transform(sent, "me")
    assert words in capfd.readouterr().err
    assert buffer.all_frames_as_string() == ""
    assert buffer.all_frames_as_yaml() == "[]"


def test_transforms_are_stored_for_ten_seconds_or_cache_time(capfd):
    moves = [message("a", "b", shifted(second), second) for second in range(1, 21)]
    assert not buffer_of(*moves).can_transform("a", "b", Time(seconds=8))
    assert buffer_of(*moves).can_transform("a", "b", Time(seconds=9))
    assert not buffer_of(*moves, cache_time=Duration(seconds=2)).can_transform("a", "b", Time(seconds=16))
    assert capfd.readouterr().err == ""
    buffer = buffer_of(*moves, moves[0])
    assert (
        "TF_OLD_DATA ignoring data from the past for frame b at time 1.000000 according to authority test"
        in capfd.readouterr().err
    )
    buffer.clear()
    assert buffer.all_frames_as_string() == "Frame b exists with parent NO_PARENT.\n"


def test_the_newest_is_new_after_each_transform():
    buffer = buffer_of(message("a", "b", shifted(1), 1), static=[message("b", "c", shifted(10), 1)])

    def newest() -> list[float]:
        return [buffer.lookup_transform("a", "c", Time()).transform.translation.x for _ in range(2)]

    assert newest() == [11, 11]
    buffer.set_transform(message("a", "b", shifted(2), 2), "test")
    assert newest() == [12, 12]
    buffer.set_transform_static(message("b", "c", shifted(20), 1), "test")
    assert newest() == [22, 22]
    buffer.lookup_transform("a", "c", Time()).transform.translation.x = 99.0  # the caller's own
    assert newest() == [22, 22]
    buffer.clear()
    assert not buffer.can_transform("a", "c", Time())


def test_transforms_may_come_in_any_order_and_twice():
    moves = [message("a", "b", shifted(second), second) for second in (3, 1, 2, 2)]
    buffer = buffer_of(*moves)
    assert [
        buffer.lookup_transform("a", "b", Time(seconds=s)).transform.translation.x for s in (1, 2, 3)
    ] == [1, 2, 3]
    assert "buffer_length: 2.000" in buffer.all_frames_as_yaml()
    assert "rate: 1.500" in buffer.all_frames_as_yaml()  # three of them


def test_a_frame_that_gets_another_parent_is_not_interpolated():
    buffer = buffer_of(
        message("a", "c", shifted(1), 1),
        message("b", "c", shifted(2), 3),
        message("a", "b", shifted(5), 3),
        message("a", "b", shifted(5), 1),
    )
    assert buffer.lookup_transform("a", "c", Time(seconds=2)).transform.translation.x == 1.0


def test_a_frame_may_become_static_and_moving_again():
    buffer = buffer_of(message("a", "b", shifted(1), 1), static=[message("a", "b", shifted(4), 1)])
    assert buffer.lookup_transform("a", "b", Time(seconds=99)).transform.translation.x == 4.0
    buffer.clear()
    assert buffer.can_transform("a", "b", Time(seconds=99))
    buffer.set_transform(message("a", "b", shifted(1), 1), "test")
    assert not buffer.can_transform("a", "b", Time(seconds=99))


def test_frames_are_reported_as_yaml():
    buffer = buffer_of(message("map", "base", shifted(1), 1), message("map", "base", shifted(1), 1.5))
    assert buffer.all_frames_as_yaml() == (
        "base: \n  parent: 'map'\n  broadcaster: 'test'\n  rate: 4.000\n  most_recent_transform: 1.500000\n"
        "  oldest_transform: 1.000000\n  buffer_length: 0.500\n"
    )
    assert buffer._frameExists("map") and buffer._getFrameStrings() == ["base", "map"]


@pytest.mark.parametrize("seed", range(5))
def test_messages_are_taken_into_another_frame(seed):
    draw = np.random.default_rng(seed)
    matrix, point, pose = random_matrix(draw), draw.uniform(-3, 3, 3), random_matrix(draw)
    buffer = buffer_of(static=[message("map", "base", matrix)])
    x, y, z = map(float, point)
    given = PointStamped()
    given.header.frame_id, given.point.x, given.point.y, given.point.z = "base", x, y, z
    moved = buffer.transform(given, "map")
    assert moved.header.frame_id == "map"
    np.testing.assert_allclose(
        [moved.point.x, moved.point.y, moved.point.z], (matrix @ [x, y, z, 1])[:3], atol=1e-12
    )

    speed = Vector3Stamped(header=given.header, vector=Vector3(x=x, y=y, z=z))
    moved = buffer.transform(speed, "map").vector
    np.testing.assert_allclose([moved.x, moved.y, moved.z], matrix[:3, :3] @ point, atol=1e-12)

    place = message("base", "", pose).transform
    stamped = PoseStamped(header=given.header)
    for axis in "xyz":
        setattr(stamped.pose.position, axis, getattr(place.translation, axis))
    stamped.pose.orientation = place.rotation
    moved = buffer.transform_full(stamped, "map", Time(), "map").pose
    turn = moved.orientation
    np.testing.assert_allclose(
        tft.quaternion_matrix([turn.x, turn.y, turn.z, turn.w])[:3, :3], (matrix @ pose)[:3, :3], atol=1e-12
    )
    np.testing.assert_allclose([moved.position.x, moved.position.y], (matrix @ pose)[:2, 3], atol=1e-12)

    unsure = PoseWithCovarianceStamped(header=given.header)
    unsure.pose.pose = stamped.pose
    covariance = draw.random((6, 6))
    unsure.pose.covariance = covariance.ravel()
    both = np.kron(np.eye(2), matrix[:3, :3])
    moved = buffer.transform(unsure, "map").pose
    np.testing.assert_allclose(moved.covariance, (both @ covariance @ both.T).ravel(), atol=1e-12)

    polygon = PolygonStamped(header=given.header)
    polygon.polygon.points = [Point32(x=x, y=y, z=z)]
    corner = buffer.transform(polygon, "map").polygon.points[0]
    np.testing.assert_allclose([corner.x, corner.y], (matrix @ [x, y, z, 1])[:2], atol=1e-5)


def test_an_unregistered_type_is_refused(capsys):
    with pytest.raises(tf2_ros.TypeException) as refusal:
        Buffer().transform(TransformStamped(), "map")
    assert refusal.value.errstr == f"Type {TransformStamped} is not loaded or supported"
    Buffer().registration.print_me()
    assert str(PointStamped) in capsys.readouterr().out


def test_a_result_is_converted_to_a_registered_type():
    given = tf2_ros.Stamped(PointStamped(), Time().to_msg(), "base")
    buffer = buffer_of(static=[message("map", "base", shifted(2))])
    tf2_ros.ConvertRegistration().add_convert((PointStamped, float), lambda point: point.point.x)
    assert buffer.transform(given, "map", new_type=float) == 2.0
    assert buffer.transform(given, "map", new_type=PointStamped) == buffer.transform(given, "map")
    tf2_ros.ConvertRegistration().add_from_msg(str, lambda point: f"x {point.point.x}")
    assert tf2_ros.convert(given, str) == "x 0.0"
    with pytest.raises(tf2_ros.TypeException):
        tf2_ros.convert(given, int)
    assert tf2_geometry_msgs.to_msg_msg(given) is given


def test_an_interface_alone_knows_no_transform():
    alone, way = BufferInterface(), ("a", "b", Time())
    for call in (alone.lookup_transform, alone.can_transform):
        with pytest.raises(tf2_ros.NotImplementedException) as refusal:
            call(*way)
    for call in (alone.lookup_transform_full, alone.can_transform_full):
        with pytest.raises(tf2_ros.NotImplementedException):
            call("a", Time(), "b", Time(), "c")
    assert str(refusal.value) == "CanTransform or LookupTransform not implemented"


@pytest.mark.parametrize("seed", range(5))
def test_tf_transformations_go_there_and_back(seed):
    draw = np.random.default_rng(seed)
    q, p = tft.random_quaternion(draw.random(3)), tft.random_quaternion(draw.random(3))
    np.testing.assert_allclose(
        tft.quaternion_multiply(q, tft.quaternion_inverse(q)), [0, 0, 0, 1], atol=1e-12
    )
    np.testing.assert_allclose(tft.quaternion_conjugate(q), tft.quaternion_inverse(q), atol=1e-12)
    both = tft.quaternion_matrix(tft.quaternion_multiply(q, p))
    np.testing.assert_allclose(
        both, tft.concatenate_matrices(tft.quaternion_matrix(q), tft.quaternion_matrix(p)), atol=1e-12
    )
    angles = draw.uniform(-1.5, 1.5, 3)
    np.testing.assert_allclose(
        tft.euler_from_quaternion(tft.quaternion_from_euler(*angles)), angles, atol=1e-12
    )
    np.testing.assert_allclose(
        tft.quaternion_from_euler(0, 0, 0.6), tft.quaternion_about_axis(0.6, (0, 0, 1)), atol=1e-12
    )
    shift = draw.uniform(-1, 1, 3)
    np.testing.assert_allclose(tft.translation_from_matrix(tft.translation_matrix(shift)), shift)
    matrix = tft.compose_matrix((1, 2, 3), None, angles, shift)
    scale, _, turned, moved, perspective = tft.decompose_matrix(matrix)
    np.testing.assert_allclose([*scale, *turned, *moved], [1, 2, 3, *angles, *shift], atol=1e-9)
    assert perspective is None
    assert tft.is_same_transform(matrix, tft.inverse_matrix(np.linalg.inv(matrix)))
    normal = tft.unit_vector(draw.uniform(0.1, 1, 3))
    across = tft.unit_vector(np.cross(normal, draw.uniform(0.1, 1, 3)))
    assert tft.is_same_transform(
        tft.reflection_matrix(*tft.reflection_from_matrix(tft.reflection_matrix(shift, normal))),
        tft.reflection_matrix(shift, normal),
    )
    zoom = tft.scale_matrix(2.5, shift, normal)
    assert tft.is_same_transform(tft.scale_matrix(*tft.scale_from_matrix(zoom)), zoom)
    shear = tft.shear_matrix(0.4, across, shift, normal)
    assert tft.is_same_transform(tft.shear_matrix(*tft.shear_from_matrix(shear)), shear)
    turn = tft.rotation_matrix(0.7, normal, shift)
    assert tft.is_same_transform(tft.rotation_matrix(*tft.rotation_from_matrix(turn)), turn)


def test_lengths_of_vectors_and_the_ends_of_a_turn():
    rows, into = np.array([[3.0, 4.0], [6.0, 8.0]]), np.zeros((2, 2))
    assert tft.vector_norm(rows, axis=1).tolist() == [5.0, 10.0]
    lengths = np.zeros(2)
    assert (tft.vector_norm(rows, axis=1, out=lengths), lengths.tolist()) == (None, [5.0, 10.0])
    assert tft.unit_vector(rows, axis=1, out=into) is None
    np.testing.assert_allclose(into, [[0.6, 0.8], [0.6, 0.8]])
    begin, end = [0, 0, 0, 1], tft.quaternion_about_axis(1.0, (0, 0, 1))
    np.testing.assert_allclose(tft.quaternion_slerp(begin, end, 0.0), begin)
    np.testing.assert_allclose(tft.quaternion_slerp(begin, end, 1.0), end)
    np.testing.assert_allclose(
        tft.quaternion_slerp(begin, -end, 0.5), tft.quaternion_about_axis(0.5, (0, 0, 1))
    )
    np.testing.assert_allclose(tft.quaternion_slerp(begin, begin, 0.5), begin)
    assert tft.random_vector(3).shape == (3,)
    assert tft.identity_matrix().tolist() == np.eye(4).tolist()

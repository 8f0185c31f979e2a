"""Point clouds go from numpy into a message and back, as with upstream's sensor_msgs_py."""

import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header

HEADER = Header(frame_id="lidar")
XYZ = np.array([[1, 2, 3], [4, 5, np.nan], [7, 8, 9]], np.float32)


def field(name: str, offset: int, datatype: int = PointField.FLOAT32, count: int = 1) -> PointField:
    return PointField(name=name, offset=offset, datatype=datatype, count=count)


COLORED = [field("x", 0), field("rgb", 4, PointField.UINT8, 3), field("ring", 8, PointField.UINT16)]


def refusal(call, *arguments, **options) -> str:
    with pytest.raises(AssertionError) as stop:
        call(*arguments, **options)
    return str(stop.value)


def test_a_cloud_of_xyz_is_laid_out_as_rviz_reads_it():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    assert [(each.name, each.offset, each.datatype, each.count) for each in cloud.fields] == [
        ("x", 0, PointField.FLOAT32, 1),
        ("y", 4, PointField.FLOAT32, 1),
        ("z", 8, PointField.FLOAT32, 1),
    ]
    assert (cloud.header, cloud.width, cloud.height) == (HEADER, 3, 1)
    assert (cloud.point_step, cloud.row_step) == (12, 36)
    assert (cloud.is_bigendian, cloud.is_dense, bytes(cloud.data)) == (False, False, XYZ.tobytes())


def test_a_cloud_comes_back_from_the_wire_as_the_array_it_was_made_of():
    sent = serialize_message(point_cloud2.create_cloud_xyz32(HEADER, XYZ))
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(deserialize_message(sent, PointCloud2)), XYZ)


def test_lists_and_arrays_make_the_same_cloud():
    made = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    assert point_cloud2.create_cloud_xyz32(HEADER, XYZ.tolist()) == made


def test_an_empty_cloud_has_no_points():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [])
    assert (cloud.width, len(cloud.data)) == (0, 0)
    assert point_cloud2.read_points_numpy(cloud).shape == (0, 3)


def test_columns_are_chosen_by_name_in_the_order_asked_for():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    chosen = point_cloud2.read_points_numpy(cloud, field_names=("y", "x"))
    np.testing.assert_array_equal(chosen, XYZ[:, [1, 0]])
    assert point_cloud2.read_points(cloud, ["y"]).dtype.names == ("y",)


def test_nans_are_skipped_where_they_are_in_a_column_that_is_read():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud, skip_nans=True), XYZ[[0, 2]])
    assert len(point_cloud2.read_points(cloud, ["x", "y"], skip_nans=True)) == 3
    cloud.is_dense = True
    assert len(point_cloud2.read_points(cloud, skip_nans=True)) == 3


@pytest.mark.parametrize("places", [[2, 0], np.array([2, 0]), range(2, -1, -2)])
def test_points_are_picked_by_their_places(places):
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud, uvs=places), XYZ[[2, 0]])


def test_points_of_several_types_come_back_as_named_columns_and_as_named_tuples():
    points = [(0.5, 255, 128, 0, 7), (1.5, 1, 2, 3, 8)]
    cloud = point_cloud2.create_cloud(HEADER, COLORED, points, point_step=16)
    assert (cloud.point_step, cloud.row_step, len(cloud.data)) == (16, 32, 32)
    read = point_cloud2.read_points(cloud)
    assert read.dtype.names == ("x", "rgb_0", "rgb_1", "rgb_2", "ring")
    assert read["rgb_1"].tolist() == [128, 2]
    first, second = point_cloud2.read_points_list(cloud)
    assert (tuple(first), second.x, second.ring) == (points[0], 1.5, 8)
    assert point_cloud2.create_cloud(HEADER, COLORED, read, point_step=16) == cloud


def test_an_organized_cloud_keeps_its_two_axes():
    image = np.arange(24, dtype=np.float32).reshape(4, 2, 3)
    fields = point_cloud2.create_cloud_xyz32(HEADER, []).fields
    cloud = point_cloud2.create_cloud(HEADER, fields, image)
    assert (cloud.width, cloud.height, cloud.row_step) == (4, 2, 48)
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud, reshape_organized_cloud=True), image)
    assert point_cloud2.read_points_numpy(cloud).shape == (8, 3)


def test_a_big_endian_cloud_is_read_rightly():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    cloud.is_bigendian, cloud.data = True, XYZ.astype(">f4").tobytes()
    np.testing.assert_array_equal(point_cloud2.read_points_numpy(cloud), XYZ)


def test_a_field_without_a_name_gets_one():
    assert point_cloud2.dtype_from_fields([field("", 0), field("y", 4)]).names == ("unnamed_field_0", "y")


def test_what_does_not_fit_is_refused_with_the_reason():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, XYZ)
    mixed = point_cloud2.create_cloud(HEADER, COLORED, [])
    assert refusal(point_cloud2.read_points, cloud, ["x", "t"]) == (
        "The cloud has no field 't', it has x, y, z."
    )
    assert refusal(point_cloud2.read_points_numpy, mixed) == (
        "The fields are of more than one type: name those of one, or use read_points()."
    )
    assert refusal(point_cloud2.create_cloud, HEADER, COLORED, XYZ) == (
        "The fields are of more than one type: give the points as a structured array."
    )
    structured = point_cloud2.read_points(cloud)
    assert refusal(point_cloud2.create_cloud, HEADER, cloud.fields[:2], structured) == (
        "The points are of [('x', '<f4'), ('y', '<f4'), ('z', '<f4')], "
        "their fields say [('x', '<f4'), ('y', '<f4')]."
    )
    assert refusal(point_cloud2.create_cloud, HEADER, cloud.fields, np.zeros((2, 2, 2, 3), np.float32)) == (
        "The points are an array of 3 axes, and a cloud has at most two."
    )
    assert refusal(point_cloud2.dtype_from_fields, [field("x", 0), field("x", 4)]) == (
        "Two fields are called 'x': give each one its own name."
    )
    assert refusal(point_cloud2.dtype_from_fields, [field("x", 0, count=0)]) == (
        "The field 'x' has the count 0: a field holds at least one number."
    )

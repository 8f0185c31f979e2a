"""Read and write sensor_msgs/PointCloud2 with upstream's functions of the same names and arguments.

A point is a row of bytes, and its fields define the position and the type of each number. The arrays here are
structured in the same way, with a named column per field: ``read_points(cloud)["x"]`` has all x. A field with
several numbers has a column for each: ``name_0``, ``name_1`` and so on.
"""

import sys
from array import array
from collections import namedtuple
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

DUMMY_FIELD_PREFIX = "unnamed_field"
_CODES = {
    PointField.INT8: "i1",
    PointField.UINT8: "u1",
    PointField.INT16: "i2",
    PointField.UINT16: "u2",
    PointField.INT32: "i4",
    PointField.UINT32: "u4",
    PointField.FLOAT32: "f4",
    PointField.FLOAT64: "f8",
}


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype:
    """Return the numpy dtype of a point.

    Args:
        fields: the fields of the point.
        point_step: size of a point in bytes; None for no bytes after the last field.

    Raises:
        AssertionError: two fields have the same name, or one holds no number.
    """
    columns: dict[str, tuple[str, int]] = {}
    for index, field in enumerate(fields):
        name, code = field.name or f"{DUMMY_FIELD_PREFIX}_{index}", _CODES[field.datatype]
        assert field.count > 0, f"The field {name!r} has the count 0: a field holds at least one number."
        for part in range(field.count):
            column = f"{name}_{part}" if field.count > 1 else name
            assert column not in columns, f"Two fields are called {column!r}: give each one its own name."
            columns[column] = code, field.offset + part * np.dtype(code).itemsize
    formats, offsets = zip(*columns.values(), strict=True) if columns else ((), ())
    layout = {"names": list(columns), "formats": list(formats), "offsets": list(offsets)}
    return np.dtype(layout if point_step is None else {**layout, "itemsize": point_step})


def read_points(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """Return the points as a structured array, one column per field.

    Args:
        cloud: the message.
        field_names: the columns to return, in this order; None for all.
        skip_nans: leave out points with a NaN in a returned column, unless the cloud says that it has none.
        uvs: the indices of the points to return; None for all.
        reshape_organized_cloud: return a cloud of several rows as an array of shape (width, height).

    Raises:
        AssertionError: the cloud has no column of a name in field_names.
    """
    native = dtype_from_fields(cloud.fields, cloud.point_step)
    stored = native.newbyteorder(">" if cloud.is_bigendian else "<")
    points = np.ndarray(cloud.width * cloud.height, stored, cloud.data).astype(native, copy=False)
    if field_names is not None:
        unknown = [name for name in field_names if name not in native.names]
        assert not unknown, f"The cloud has no field {unknown[0]!r}, it has {', '.join(native.names)}."
        points = points[list(field_names)]
    if skip_nans and not cloud.is_dense:
        points = points[~np.any([np.isnan(points[name]) for name in points.dtype.names], axis=0)]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """Return the points as a plain array, one row per point; for the arguments see read_points().

    Raises:
        AssertionError: as read_points(); or the columns are of more than one type.
    """
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    types = {points.dtype[name] for name in points.dtype.names}
    assert len(types) == 1, "The fields are of more than one type: name those of one, or use read_points()."
    return structured_to_unstructured(points)


def read_points_list(
    cloud: PointCloud2,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
) -> list[tuple]:
    """Return the points as named tuples, which is slow; for the arguments see read_points().

    Raises:
        AssertionError: as read_points().
    """
    points = read_points(cloud, field_names, skip_nans, uvs)
    return [*map(namedtuple("Point", points.dtype.names)._make, points)]


def create_cloud(
    header: Header,
    fields: Sequence[PointField],
    points: Iterable,
    point_step: int | None = None,
) -> PointCloud2:
    """Return the points as a message.

    Args:
        header: frame and time of the cloud.
        fields: the position and the type of each number of a point.
        points: the points, each a sequence of numbers in the order of the fields; or a structured array with
            the dtype of the fields; or a plain array whose last axis has the fields, all of one type. An
            array of points with two axes makes a cloud of (width, height).
        point_step: size of a point in bytes; None for no bytes after the last field.

    Raises:
        AssertionError: the array does not fit the fields.
    """
    dtype = dtype_from_fields(fields, point_step)
    if not isinstance(points, np.ndarray):
        points = np.array([tuple(point) for point in points], dtype)
    elif points.dtype.names is None:
        types = {field.datatype for field in fields}
        assert len(types) == 1, "The fields are of more than one type: give the points as a structured array."
        points = unstructured_to_structured(points, dtype)
    assert points.dtype == dtype, f"The points are of {points.dtype}, their fields say {dtype}."
    assert points.ndim <= 2, f"The points are an array of {points.ndim} axes, and a cloud has at most two."
    width, height = points.shape if points.ndim == 2 else (len(points), 1)
    return PointCloud2(
        header=header,
        height=height,
        width=width,
        fields=fields,
        is_bigendian=sys.byteorder == "big",
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * width,
        data=array("B", points.tobytes()),
        is_dense=False,
    )


def create_cloud_xyz32(header: Header, points: Iterable) -> PointCloud2:
    """Return points of (x, y, z), in metres, as a message with these three fields of float32."""
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points)

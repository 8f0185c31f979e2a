"""Poses, frames, clouds and images as layers that the reader asks for."""

import base64
import io
import math

import numpy as np
import pytest
from geometry_msgs.msg import Pose, PoseArray, PoseWithCovarianceStamped, TransformStamped
from nav2_msgs.msg import Particle, ParticleCloud
from nav_msgs.msg import Odometry
from PIL import Image as Picture
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage

from sim import World, run
from sim.view.frame_tree import FrameTree, flat
from sim.view.layers import NewestLayers, layers_of, quiet_layers
from sim.view.live_view import LiveView
from tests.sim.recordings import published


def turned(message, x, y, yaw):
    message.position.x, message.position.y = x, y
    message.orientation.z, message.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def estimate(x, y, yaw, covariance=(0.0, 0.0, 0.0), frame="map"):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    turned(message.pose.pose, x, y, yaw)
    message.pose.covariance[0], message.pose.covariance[1], message.pose.covariance[7] = covariance
    message.pose.covariance[6] = covariance[1]
    return message


def transforms(*rows):
    return TFMessage(transforms=[transform(*row) for row in rows])


def transform(parent, child, x, y, yaw):
    sent = TransformStamped(child_frame_id=child)
    sent.header.frame_id = parent
    sent.transform.translation.x, sent.transform.translation.y = x, y
    sent.transform.rotation.z, sent.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return sent


def image(pixels, encoding="rgb8", padding=0):
    height, width = pixels.shape[:2]
    rows = np.pad(pixels.reshape(height, -1), ((0, 0), (0, padding)))
    size = {"height": height, "width": width, "step": rows.shape[1]}
    return Image(**size, encoding=encoding, data=rows.tobytes())


def shown(data):
    with Picture.open(io.BytesIO(base64.b64decode(data["webp"]))) as picture:
        return np.asarray(picture.convert("RGB")).astype(int)


def test_a_pose_has_its_covariance_and_is_quiet():
    recording = published("/amcl_pose", [(1.0, estimate(1.0, 2.0, 0.5, (0.04, 0.01, 0.09)))])
    assert layers_of(recording) == []
    (layer,) = layers_of(recording, quiet=True)
    about = {"stamp": 1000, "topic": "/amcl_pose", "kind": "pose"}
    assert layer == {**about, "data": [1.0, 2.0, 0.5, 0.04, 0.01, 0.09]}


def test_odometry_is_drawn_from_the_robots_start():
    world = World.load("maze")
    frames = FrameTree(world)
    x, y, yaw = world.start
    ahead = frames.where("odom").of(flat(1.0, 0.0, 0.0))
    assert ahead.position[:2] == pytest.approx((x + math.cos(yaw), y + math.sin(yaw)))
    recording = run(world="maze", seconds=1, quiet=True)
    (odom,) = [track for track in quiet_layers(recording)["beliefs"] if track["topic"] == "/odom"]
    assert [column[0] for column in odom["columns"]] == [round(v * 1000) for v in (x, y, yaw)] + [0, 0, 0]


def test_a_covariance_turns_with_its_frame():
    frames = transforms(("map", "odom", 2.0, 0.0, math.pi / 2))
    recording = published("/tf", [(0.0, frames)])
    pose = estimate(1.0, 0.0, 0.0, (0.04, 0.0, 0.01), "odom")
    recording.published += published("/pose", [(1.0, pose)]).published
    (pose,) = [layer for layer in layers_of(recording, quiet=True) if layer["kind"] == "pose"]
    assert pose["data"] == pytest.approx([2.0, 1.0, math.pi / 2, 0.01, 0.0, 0.04], abs=1e-4)


def test_frames_are_where_their_transforms_lead():
    frames = FrameTree(None)
    frames.add(transforms(("map", "odom", 1.0, 0.0, math.pi / 2), ("odom", "base_link", 2.0, 0.0, 0.0)))
    assert frames.names == ["map", "odom", "base_link"]
    assert frames.where("/base_link").position == pytest.approx((1.0, 2.0, 0.0))
    assert frames.where("base_link").yaw == pytest.approx(math.pi / 2)
    back = frames.where("base_link").of(frames.where("base_link").inverse)
    assert back.position == pytest.approx((0.0, 0.0, 0.0))
    assert frames.where("elsewhere") is None
    frames.add(transforms(("b", "a", 0.0, 0.0, 0.0), ("a", "b", 0.0, 0.0, 0.0)))
    assert frames.where("a") is None


def test_a_transform_without_a_direction_is_left_out():
    frames, empty = FrameTree(None), transform("map", "odom", 1.0, 0.0, 0.0)
    empty.transform.rotation.w = 0.0
    frames.add(TFMessage(transforms=[empty]))
    assert frames.names == []


def test_a_replay_has_the_frames_of_its_robot():
    beliefs = quiet_layers(run(world="room", seconds=2, quiet=True))["beliefs"]
    tracks = {track["name"]: track for track in beliefs if track["kind"] == "frames"}
    assert sorted(tracks) == ["base_link", "base_scan", "odom"]
    x, y, _ = World.load("room").start
    assert [column[0] for column in tracks["odom"]["columns"][:2]] == [round(x * 1000), round(y * 1000)]


def test_a_cloud_has_a_limited_number_of_poses():
    message = PoseArray(poses=[turned(Pose(), 0.01 * index, 1.0, 0.1) for index in range(500)])
    message.header.frame_id = "map"
    (layer,) = quiet_layers(in_a_world(published("/particle_cloud", [(1.0, message)])))["seen"]
    assert (layer["kind"], len(layer["data"])) == ("cloud", 120)
    assert layer["data"][0] == [0.0, 1.0, 0.1]


def test_the_particles_of_a_filter_are_a_cloud_that_is_shown_until_the_reader_hides_it():
    poses = [turned(Pose(), 0.01 * index, 1.0, 0.1) for index in range(500)]
    message = ParticleCloud(particles=[Particle(pose=pose, weight=0.002) for pose in poses])
    message.header.frame_id = "map"
    recording = in_a_world(published("/particle_cloud", [(1.0, message)]))
    (layer,) = quiet_layers(recording)["seen"]
    assert (layer["kind"], len(layer["data"]), layer["data"][0]) == ("cloud", 120, [0.0, 1.0, 0.1])
    view = LiveView(recording.world)
    assert view.shown == ["/particle_cloud"]
    view.close()


def in_a_world(recording):
    recording.world = World.load("room")
    return recording


@pytest.mark.parametrize("encoding, color", [("rgb8", (200, 30, 30)), ("bgr8", (30, 30, 200))])
@pytest.mark.parametrize("padding", [0, 3])
def test_an_image_keeps_its_colors(encoding, color, padding):
    pixels = np.full((48, 64, 3), color, np.uint8)
    (layer,) = layers_of(published("/image", [(1.0, image(pixels, encoding, padding))]), quiet=True)
    assert (layer["data"]["width"], layer["data"]["height"]) == (64, 48)
    picture = shown(layer["data"])
    assert picture.shape == (96, 128, 3)  # doubled
    assert np.abs(picture - (200, 30, 30)).max() < 8


def test_a_single_red_pixel_of_a_small_image_stays_red():
    pixels = np.full((48, 64, 3), 210, np.uint8)
    pixels[20, 30] = 205, 35, 35
    (layer,) = layers_of(published("/image", [(1.0, image(pixels))]), quiet=True)
    red, green, blue = shown(layer["data"])[40:42, 60:62].reshape(-1, 3).mean(0)
    assert red - max(green, blue) > 50


@pytest.mark.parametrize(
    "message",
    [
        image(np.zeros((4, 4, 1), np.uint8), "32FC1"),
        Image(width=4, height=4, encoding="rgb8", step=12, data=b"few"),
        Image(encoding="rgb8"),
    ],
    ids=["encoding", "bytes", "empty"],
)
def test_an_image_that_can_not_be_shown_is_left_out(message):
    assert layers_of(published("/image", [(1.0, message)]), quiet=True) == []


def test_a_run_without_a_world_has_only_images():
    seen = published("/image", [(1.0, image(np.zeros((4, 4, 3), np.uint8)))])
    assert [layer["kind"] for layer in quiet_layers(seen)["seen"]] == ["image"]
    poses = published("/amcl_pose", [(1.0, estimate(1.0, 2.0, 0.5))])
    assert quiet_layers(poses) == {"seen": [], "beliefs": []}


def test_live_the_page_gets_what_it_asks_for():
    odometry = Odometry()
    odometry.header.frame_id = "odom"
    recording = in_a_world(published("/odom", [(1.0, odometry)]))
    newest = NewestLayers(recording.world)
    newest.read(recording)
    assert newest.changed() is None
    assert newest.quiet == [["/odom", "pose"]]
    assert newest.moving(1.0, []) == []
    (layer,) = newest.moving(1.0, ["/odom"])
    x, y, yaw = World.load("room").start
    assert layer["data"] == pytest.approx([x, y, yaw, 0, 0, 0], abs=1e-4)


def test_a_frame_carries_the_layers_that_the_page_has_asked_for():
    recording = run(world="room", seconds=1, quiet=True)
    view, sent = LiveView(recording.world), []
    view.send = lambda content, buffers: sent.append(content["layers"])
    view.frame(1.0, [(0.0, 0.0, 0.0)], None)
    view.state({"recording": recording, "speed": 1.0, "stamp": 1.0})
    assert view.quiet == [["/odom", "pose"], ["/tf", "frames"]]
    view.shown = ["/odom"]  # sent at once: the run may be paused
    view.frame(1.1, [(0.0, 0.0, 0.0)], None)
    view.shown = ["/tf"]
    kinds = [[layer["kind"] for layer in layers] for layers in sent]
    assert kinds == [[], ["pose"], ["pose"], ["frames"] * 3]
    view.close()

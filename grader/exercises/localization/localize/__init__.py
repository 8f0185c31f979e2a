"""From a pose at the time of a scan to the frame odom, which a driver trusts."""

import math

from grader.checks import Missed, has_no_contacts, publishes, subscribes
from grader.checks.frames import FULL_TURN, TF, Broadcast, between, broadcasts
from grader.checks.mistakes import usual_mistake
from grader.checks.motion import goal_in
from grader.checks.no_data import no_data
from grader.companions.map_messages import pose_2d
from grader.exercise import Exercise
from grader.exercises.localization.localize.scan_matcher import composed, matching, relative, slippery_room
from grader.geometry import Pose2D
from grader.geometry.near import is_near
from grader.responses import from_course
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds, since_start

__all__ = ["localize", "matching", "slippery_room"]

POSE = "geometry_msgs/msg/PoseWithCovarianceStamped"
SOON: Seconds = 0.045  # after a pose arrives
CLOSE = 0.02  # m, rad
ARRIVED = 0.3  # m from the goal
ORIGIN = Pose2D(0.0, 0.0, 0.0)


def _done(run: Recording) -> bool:
    """Return whether the robot has been at its goal, or stands long after it could be."""
    goal, last = goal_in(run), run.path[-1]
    return run.stamp > 5.0 and math.dist(goal, (last.x, last.y)) < 0.12


localize = Exercise("localize", "From map to odom", world=slippery_room, seconds=45, companions=matching,
                    until=_done, seeds=(1, 2), variants=Variants(
    {"tolerance": (0.5, 0.4, 0.6)},  # s that are added to the stamp
    texts=("{tolerance} s", "Duration(seconds={tolerance})"),
))


@localize.check(2)
def broadcasts_odom(run: Recording) -> list[Broadcast]:
    """It subscribes to /initialpose and /scan_pose, and sends map → odom, and no other frame, on /tf."""
    subscribes(run, "/initialpose", POSE)
    subscribes(run, "/scan_pose", POSE)
    if broadcasts(run, "/tf_static"):
        hint = "/tf_static is for what never changes. The odometry drifts: use a TransformBroadcaster."
        raise Missed("map → odom on /tf", "a transform on /tf_static", hint)
    publishes(run, "/tf", TF)
    sent = broadcasts(run, "/tf")
    if any(one.message.child_frame_id.lstrip("/") == "base_link" for one in sent):
        hint = ("base_link already has a parent, odom, which the robot publishes. A frame with two parents "
                "jumps between them: publish the missing part, map → odom.")
        raise Missed("map → odom on /tf", "a second parent of base_link", hint)
    return between(sent, "map", "odom", "/tf", lambda one: False)


def _odometry(run: Recording, stamp: Seconds) -> Pose2D:
    """The odometry at a time: that of the nearest message."""
    rows = from_course(run, "/odom", at_least=5, what="odometry")
    nearest = min(rows, key=lambda row: abs(since_start(row.message.header.stamp) - stamp))
    return Pose2D.from_message(nearest.message.pose.pose)


def _fixes(run: Recording) -> list[Message]:
    """The poses that a node had the time to answer."""
    rows = [row for topic in ("/initialpose", "/scan_pose") for row in run.messages(topic) if row.from_course]
    rows = [row for row in rows if row.stamp + 2 * SOON < run.ended.stamp]
    if len(rows) < 4:
        raise no_data(run, "poses", f"{len(rows)}", [])
    return rows


def _right(run: Recording, fix: Message) -> Pose2D:
    """The pose of odom in the map, by a pose of base_link."""
    odometry = _odometry(run, since_start(fix.message.header.stamp))
    return composed(Pose2D.from_message(fix.message.pose.pose), relative(odometry, ORIGIN))


BASE = ("That is where base_link is in map. Go from there back to where the odometry began: multiply by the "
        "inverse of odom → base_link.")
ORDER = "The product is in the other order: first map → base_link, then the inverse of odom → base_link."
NOT_INVERTED = "Multiply by the inverse of odom → base_link, not by itself."
NEWEST = ("That combines the pose of then with the odometry of now. Look up odom → base_link at the pose's "
          "header.stamp.")
SUBTRACTED = ("Poses aren't subtracted number by number: rotate the odometry's position by the difference "
              "of the headings first.")
OTHERWISE = f"Look up odom → base_link at the pose's stamp, invert it, and compose. {FULL_TURN}"


def _hint(run: Recording, fix: Message, found: Pose2D) -> str:
    """The hint for the mistake that leads to this in place of the right transform."""
    pose, then = Pose2D.from_message(fix.message.pose.pose), since_start(fix.message.header.stamp)
    odometry, now = _odometry(run, then), _odometry(run, fix.stamp)
    back, dx, dy = relative(odometry, ORIGIN), pose.x - odometry.x, pose.y - odometry.y
    mistakes = {
        BASE: pose,
        ORDER: composed(back, pose),
        NOT_INVERTED: composed(pose, odometry),
        NEWEST: composed(pose, relative(now, ORIGIN)),
        SUBTRACTED: Pose2D(dx, dy, math.remainder(pose.yaw - odometry.yaw, math.tau)),
    }
    return usual_mistake(mistakes, lambda wrong: found.is_near(wrong, CLOSE, CLOSE)) or OTHERWISE


@localize.check(4, after=broadcasts_odom)
def corrects_the_odometry(run: Recording, sent: list[Broadcast]) -> list[tuple[Message, Broadcast]]:
    """After each pose, map → odom puts base_link there at the time of that pose."""
    pairs = []
    for fix in _fixes(run):
        found = [one for one in sent if 0 <= one.stamp - fix.stamp <= SOON]
        if not found:
            hint = f"Send it in the callback of {fix.topic}, at once: it gives a pose of base_link in map."
            raise Missed(f"a transform for {fix.topic} at {fix.stamp:.3g} s", "none within 0.05 s", hint)
        right, one = _right(run, fix), found[0]
        if not (one.is_rotation and one.pose.is_near(right, CLOSE, CLOSE)):
            expected = f"odom at {right} for {fix.topic} at {fix.stamp:.3g} s"
            raise Missed(expected, f"{one.pose}", _hint(run, fix, one.pose))
        pairs.append((fix, one))
    return pairs


@localize.check(2, after=corrects_the_odometry)
def stamps_it(run: Recording, pairs: list[tuple[Message, Broadcast]]) -> None:
    """The transform's stamp is the pose's plus 0.5 s."""
    tolerance = localize.drawn.tolerance
    for fix, one in pairs:
        wanted = since_start(fix.message.header.stamp) + tolerance
        if not is_near(one.measured, wanted, 0.001):
            hint = ("The correction is for the time of the pose, header.stamp, not for now. Add "
                    f"{tolerance} s: (Time.from_msg(stamp) + Duration(seconds={tolerance})).to_msg().")
            raise Missed(f"{wanted:.3f} s", f"{one.measured:.3f} s at {one.stamp:.3g} s", hint)


@localize.check(2, after=corrects_the_odometry)
def reports_the_pose(run: Recording) -> None:
    """Each pose is also published on /amcl_pose, with its stamp and its covariance."""
    rows = publishes(run, "/amcl_pose", POSE)
    for fix in _fixes(run):
        sent, found = fix.message, [row.message for row in rows if 0 <= row.stamp - fix.stamp <= SOON]
        hint = "Publish the message itself: pose, covariance and header are already right."
        if not found:
            raise Missed(f"a message for {fix.topic} at {fix.stamp:.3g} s", "none within 0.05 s", hint)
        same = found[0].header == sent.header and list(found[0].pose.covariance) == list(sent.pose.covariance)
        if not (same and is_near(pose_2d(found[0].pose.pose)[:2], pose_2d(sent.pose.pose)[:2], 0.001)):
            raise Missed(f"pose, covariance and stamp of {fix.topic} at {fix.stamp:.3g} s", "others", hint)


@localize.check(2, after=corrects_the_odometry)
def lets_the_robot_arrive(run: Recording) -> None:
    """The driver, which trusts /tf, reaches the goal and touches nothing, though the wheels slip."""
    goal, last = goal_in(run), run.path[-1]
    gap = math.dist(goal, (last.x, last.y))
    if not gap < ARRIVED:
        hint = "Look at the replay with its frames: from when on is odom wrong, or too old for the driver?"
        raise Missed(f"the robot within {ARRIVED:g} m of its goal", f"{gap:.2f} m", hint, picture="path")
    has_no_contacts(run)

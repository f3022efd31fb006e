# SPDX-License-Identifier: BSD-3-Clause
"""A robot made of messages, for the rostests."""
import math
import time

import numpy
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL = 80, 60, 40.0
CAMERA_FRAME = "camera_optical_frame"


def wait_until(condition, timeout_s, what):
    """Polls on the wall clock; the clock of ROS may stand still. `what`: text or its maker."""
    deadline = time.monotonic() + timeout_s
    while time.monotonic() < deadline:
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("not within %g s: %s" % (timeout_s, what() if callable(what) else what))


def quaternion(yaw):
    """Of a robot that looks along yaw, as (x, y, z, w)."""
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)


def multiplied(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


# Optical axes (x right, y down, z forward) seen from a body (x forward, y left, z up).
BODY_TO_OPTICAL = (-0.5, 0.5, -0.5, 0.5)


def transform(stamp, parent, child, position, rotation):
    message = TransformStamped()
    message.header.stamp = stamp
    message.header.frame_id = parent
    message.child_frame_id = child
    (message.transform.translation.x, message.transform.translation.y,
     message.transform.translation.z) = position
    (message.transform.rotation.x, message.transform.rotation.y, message.transform.rotation.z,
     message.transform.rotation.w) = rotation
    return message


def depth_image(stamp, metres):
    """A 32FC1 image, all of it `metres` away, or of these pixels."""
    pixels = numpy.empty((HEIGHT, WIDTH), dtype=numpy.float32)
    pixels[...] = metres
    image = Image()
    image.header.stamp = stamp
    image.header.frame_id = CAMERA_FRAME
    image.width, image.height, image.step = WIDTH, HEIGHT, 4 * WIDTH
    image.encoding = "32FC1"
    image.data = pixels.tobytes()
    return image


def camera_info(focal=FOCAL, width=WIDTH, height=HEIGHT):
    info = CameraInfo()
    info.width, info.height = width, height
    info.K = [focal, 0, WIDTH / 2, 0, focal, HEIGHT / 2, 0, 0, 1]
    return info


def two_rooms(stamp, frame="map"):
    """A laser map: two rooms of 4 x 4 m, joined by a door 1 m wide at x = 4."""
    cells = numpy.zeros((86, 166), dtype=numpy.int8)
    cells[:3, :] = cells[-3:, :] = cells[:, :3] = cells[:, -3:] = 100
    cells[:, 82:84] = 100
    cells[33:53, 82:84] = 0
    grid = OccupancyGrid()
    grid.header.stamp = stamp
    grid.header.frame_id = frame
    grid.info.resolution = 0.05
    grid.info.height, grid.info.width = cells.shape
    grid.info.origin.position.x = grid.info.origin.position.y = -0.15
    grid.info.origin.orientation.w = 1.0
    grid.data = cells.ravel().tolist()
    return grid


class Robot:
    """Publishes what a robot publishes, at times of its own."""

    def __init__(self, clock=False):
        self.clock_publisher = rospy.Publisher("/clock", Clock, queue_size=10) if clock else None
        self.tf_publisher = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.info_publisher = rospy.Publisher("/camera/depth/camera_info", CameraInfo,
                                              queue_size=10)
        self.depth_publisher = rospy.Publisher("/camera/depth/image_rect", Image, queue_size=100)

    def wait_for_subscribers(self, *publishers, connections=1):
        for publisher in publishers:
            wait_until(lambda p=publisher: p.get_num_connections() >= connections, 30,
                       "%d listen to %s" % (connections, publisher.name))

    def set_clock(self, stamp):
        self.clock_publisher.publish(Clock(clock=stamp))

    def send_pose(self, stamp, x=0.0, y=0.0, yaw=0.0):
        body = quaternion(yaw)
        self.tf_publisher.publish(TFMessage(transforms=[
            transform(stamp, "map", "base_link", (x, y, 0.0), body),
            transform(stamp, "map", CAMERA_FRAME, (x, y, 1.2),
                      multiplied(body, BODY_TO_OPTICAL))]))

    def send_frame(self, stamp, x=0.0, y=0.0, yaw=0.0, metres=3.0):
        if self.clock_publisher:
            self.set_clock(stamp)
        self.send_pose(stamp, x, y, yaw)
        self.depth_publisher.publish(depth_image(stamp, metres))


class Diagnostics:
    """The newest values one node reports."""

    def __init__(self, name):
        self.name = name
        self.values = {}
        self.reports = 0
        self.stamp_s = 0.0
        self.level = None
        self.message = ""
        self.subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self.receive)

    def receive(self, array):
        for status in array.status:
            if status.name.endswith(self.name):
                self.level, self.message = status.level, status.message
                self.values = {entry.key: entry.value for entry in status.values}
                self.stamp_s = array.header.stamp.to_sec()
                self.reports += 1

    def count(self, key):
        return int(self.values.get(key, "-1"))

    def wait_for_news(self, reports=2):
        """Until so many reports were made from now on; the first may have been on its way."""
        seen = self.reports
        wait_until(lambda: self.reports >= seen + reports, 20, "reports of " + self.name)

    def wait_for(self, key, at_least, timeout_s=20):
        wait_until(lambda: self.count(key) >= at_least, timeout_s,
                   lambda: "%s of %s >= %d: %s" % (key, self.name, at_least, self.values))


class RosLog:
    """What the nodes say, each line after the name of its node."""

    def __init__(self):
        self.lines = []
        self.subscriber = rospy.Subscriber("/rosout", Log, self.receive, queue_size=1000)

    def receive(self, line):
        self.lines.append("%s: %s" % (line.name, line.msg))

    def said(self, *words):
        return any(all(word in line for word in words) for line in list(self.lines))

    def count(self, words):
        return sum(words in line for line in list(self.lines))

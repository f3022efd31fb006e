#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Colour and depth images into the semantics nodelet; its model finds the same boxes everywhere."""
import sys
import unittest

import numpy
import rospy
import rostest
from occusg.msg import DetectionArray
from sensor_msgs.msg import CameraInfo, Image

from robot import CAMERA_FRAME, Diagnostics, Robot, wait_until

SIDE = 64  # of the model's input [pixels]
FOCAL = 64.0
DEPTH_M = 2.0


def color_image(stamp):
    """Red on the left, blue on the right: so the model's masks are."""
    pixels = numpy.zeros((SIDE, SIDE, 3), dtype=numpy.uint8)
    pixels[:, :SIDE // 2, 0] = 255
    pixels[:, SIDE // 2:, 2] = 255
    image = Image(width=SIDE, height=SIDE, step=3 * SIDE, encoding="rgb8", data=pixels.tobytes())
    image.header.stamp, image.header.frame_id = stamp, CAMERA_FRAME
    return image


def depth_image(stamp):
    pixels = numpy.full((SIDE, SIDE), DEPTH_M, dtype=numpy.float32)
    image = Image(width=SIDE, height=SIDE, step=4 * SIDE, encoding="32FC1", data=pixels.tobytes())
    image.header.stamp, image.header.frame_id = stamp, CAMERA_FRAME
    return image


def camera_info(stamp, focal=FOCAL):
    info = CameraInfo(width=SIDE, height=SIDE)
    info.header.stamp, info.header.frame_id = stamp, CAMERA_FRAME
    info.K = [focal, 0, SIDE / 2, 0, focal, SIDE / 2, 0, 0, 1]
    return info


class SemanticsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("semantics_test")
        cls.robot = Robot()
        cls.color_publisher = rospy.Publisher("/camera/rgb/image_rect_color", Image, queue_size=10)
        cls.received = []
        rospy.Subscriber("/occusg/detections", DetectionArray, cls.received.append)
        cls.strict = []
        rospy.Subscriber("/occusg/strict_detections", DetectionArray, cls.strict.append)
        cls.diagnostics = Diagnostics("/semantics: semantics")
        cls.robot.wait_for_subscribers(cls.color_publisher, cls.robot.depth_publisher,
                                       cls.robot.info_publisher, cls.robot.tf_publisher,
                                       connections=2)

    def send(self, change=lambda color, depth, info: None, with_pose=True):
        stamp = rospy.Time.now()
        color, depth, info = color_image(stamp), depth_image(stamp), camera_info(stamp)
        change(color, depth, info)
        if with_pose:
            self.robot.send_pose(stamp)
        self.robot.info_publisher.publish(info)
        self.color_publisher.publish(color)
        self.robot.depth_publisher.publish(depth)
        return stamp

    def test_detections_arrive_where_the_objects_are(self):
        before = len(self.received)

        def is_there():
            self.send()
            return len(self.received) > before
        wait_until(is_there, 30, "detections")
        found = self.received[-1]
        self.assertEqual(found.header.frame_id, "map")
        lamp = [d for d in found.detections if d.class_name == "lamp"]
        self.assertEqual(len(lamp), 1, found)
        # Pixels 40..56 x 24..40 at 2 m, of a camera 1.2 m above the ground that looks along x.
        self.assertAlmostEqual(lamp[0].score, 0.95, delta=0.01)
        self.assertAlmostEqual(lamp[0].centroid.x, DEPTH_M, delta=0.01)
        self.assertAlmostEqual(lamp[0].centroid.y, -0.5, delta=0.1)
        self.assertAlmostEqual(lamp[0].centroid.z, 1.2, delta=0.1)
        self.assertLessEqual({d.class_name for d in found.detections}, {"chair", "lamp", "table"})

    def test_parameters_of_the_pipeline_say_what_is_a_detection(self):
        def has_seen():
            self.send()
            return bool(self.strict)
        wait_until(has_seen, 30, "what a node finds that must be sure")
        self.assertEqual(self.strict[0].detections, [])

    def counted(self, reason, *arguments, **named):
        """Sends what cannot be used until it was counted, and sees that nothing came of it."""
        key = "dropped: " + reason
        wait_until(lambda: key in self.diagnostics.values, 10, "diagnostics")
        before, sent = self.diagnostics.count(key), set()

        def is_counted():
            sent.add(self.send(*arguments, **named))
            return self.diagnostics.count(key) > before
        wait_until(is_counted, 30, key)
        self.assertEqual(sent & {found.header.stamp for found in self.received}, set())

    def test_failure_mode_02_wrong_encodings_and_sizes_are_counted(self):
        def spoil_color(color, _depth, _info):
            color.encoding = "32FC1"
        self.counted("bad_image", spoil_color)

        def spoil_depth(_color, depth, _info):
            depth.data = depth.data[:-1]
        self.counted("bad_image", spoil_depth)

    def test_failure_mode_03_bad_intrinsics_are_counted(self):
        def spoil(_color, _depth, info):
            info.K = [0.0] * 9
        self.counted("bad_image", spoil)

    def test_failure_mode_04_without_a_transform_nothing_is_placed(self):
        def elsewhere(_color, depth, _info):
            depth.header.frame_id = "nowhere"
        self.counted("no_transform", elsewhere, with_pose=False)


if __name__ == "__main__":
    rostest.rosrun("occusg", "semantics_test", SemanticsTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Poses that come as Odometry or PoseStamped, the camera's mount on tf_static; a nodelet that cannot start."""
import sys
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from robot import (BODY_TO_OPTICAL, CAMERA_FRAME, Diagnostics, Robot, RosLog, camera_info,
                   depth_image, transform, wait_until)


class PosesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = RosLog.__new__(RosLog)
        rospy.init_node("poses_test")
        cls.log.__init__()
        cls.no_model = Diagnostics("no_model: start")

    def test_odometry_and_poses_with_a_static_mount_are_mapped_with(self):
        robot = Robot()
        odometry_publisher = rospy.Publisher("/wheels", Odometry, queue_size=10)
        pose_publisher = rospy.Publisher("/slam_pose", PoseStamped, queue_size=10)
        mount = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        mount.publish(TFMessage(transforms=[
            transform(rospy.Time.now(), "base_link", CAMERA_FRAME, (0.0, 0.0, 1.2),
                      BODY_TO_OPTICAL)]))
        robot.wait_for_subscribers(robot.info_publisher, robot.depth_publisher, connections=2)
        robot.wait_for_subscribers(odometry_publisher, pose_publisher)
        nodes = [Diagnostics(name + ": mapping") for name in ("odometry_mapping", "pose_mapping")]
        for step in range(60):
            stamp = rospy.Time.now()
            odometry = Odometry()
            odometry.header.stamp, odometry.header.frame_id = stamp, "odom"
            odometry.child_frame_id = "base_link"
            odometry.pose.pose.position.x = 0.02 * step
            odometry.pose.pose.orientation.w = 1.0
            pose = PoseStamped(pose=odometry.pose.pose)
            pose.header.stamp, pose.header.frame_id = stamp, "map"
            odometry_publisher.publish(odometry)
            pose_publisher.publish(pose)
            robot.info_publisher.publish(camera_info())
            robot.depth_publisher.publish(depth_image(stamp, 3.0))
            time.sleep(0.1)
        for node in nodes:
            node.wait_for("images used", 30)

    def test_a_nodelet_without_its_model_says_so_once_and_in_the_diagnostics(self):
        wait_until(lambda: self.no_model.level == DiagnosticStatus.ERROR, 30, "an error is told")
        self.assertIn("~model", self.no_model.message)
        before = self.no_model.reports
        # Five more reports, one a second: a nodelet that is loaded again would have said it again.
        wait_until(lambda: self.no_model.reports >= before + 5, 30, "reports go on")
        self.assertLessEqual(self.log.count("does not start"), 1)


if __name__ == "__main__":
    rostest.rosrun("occusg", "poses_test", PosesTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Within 5 s of starting without usable input a node says in one line which is missing."""
import sys
import time
import unittest

import rospy
import rostest

from robot import Robot, RosLog, camera_info, depth_image, wait_until


class MissingInputTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = RosLog.__new__(RosLog)
        rospy.init_node("missing_input_test")
        cls.log.__init__()

    def test_missing_topics_are_named(self):
        wait_until(lambda: self.log.said("nothing is mapped", "no depth image on /nobody/image",
                                         "no camera_info on /nobody/info"), 30, "said by mapping")
        wait_until(lambda: self.log.said("no scene graph", "no free space on /nobody/free_space"),
                   30, "said by scene_graph")

    def test_failure_mode_04_missing_transform_is_named_by_its_frames(self):
        robot = Robot()
        robot.wait_for_subscribers(robot.info_publisher, robot.depth_publisher)
        for _ in range(40):
            robot.info_publisher.publish(camera_info())
            robot.depth_publisher.publish(depth_image(rospy.Time.from_sec(time.time()), 2.0))
            time.sleep(0.1)
        wait_until(lambda: self.log.said("no transform map <- camera_optical_frame"), 10,
                   "the transform is named")

    def test_failure_mode_07_clock_that_does_not_run_is_said(self):
        wait_until(lambda: self.log.said("use_sim_time", "/clock"), 30, "the clock is missed")


if __name__ == "__main__":
    rostest.rosrun("occusg", "missing_input_test", MissingInputTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From SIGINT to the end it takes 5 s at most, and what was found is saved."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rospy
import rostest

from robot import Diagnostics, Robot, camera_info, two_rooms, wait_until
from nav_msgs.msg import OccupancyGrid


class ShutdownTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("shutdown_test")
        cls.robot = Robot()
        cls.folder = rospy.get_param("~folder", tempfile.mkdtemp(prefix="occusg_shutdown_test_"))

    def start(self, command, name, *arguments):
        return subprocess.Popen([rospy.get_param("~" + command), "__name:=" + name,
                                 "_save_folder:=" + self.folder] + list(arguments))

    def end(self, process, number):
        started = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=15)
        self.assertLess(time.monotonic() - started, 5.0)

    def test_row_15_mapping_saves_on_sigint(self):
        process = self.start("mapping", "mapped", "depth/image_rect:=/camera/depth/image_rect",
                             "depth/camera_info:=/camera/depth/camera_info")
        diagnostics = Diagnostics("mapped: mapping")
        self.robot.wait_for_subscribers(self.robot.depth_publisher, self.robot.info_publisher,
                                        self.robot.tf_publisher)
        self.robot.info_publisher.publish(camera_info())
        for i in range(8):
            self.robot.send_frame(rospy.Time.now(), yaw=0.4 * i)
            time.sleep(0.2)
        diagnostics.wait_for("images used", 4)
        self.end(process, signal.SIGINT)
        saved = os.path.join(self.folder, "last", "free_space.pgm")
        self.assertGreater(os.path.getsize(saved), 100)

    def test_row_15_scene_graph_saves_on_sigterm(self):
        process = self.start("scene_graph", "graphed", "free_space:=/map")
        publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        publisher.publish(two_rooms(rospy.Time.now()))
        diagnostics = Diagnostics("graphed: scene graph")

        def is_used():
            self.robot.send_pose(rospy.Time.now(), 1.0, 2.0)
            time.sleep(0.1)
            return diagnostics.count("maps used") > 0
        wait_until(is_used, 30, "the map is used")
        self.end(process, signal.SIGTERM)
        with open(os.path.join(self.folder, "last", "rooms.json")) as rooms:
            self.assertEqual(rooms.read().count('"id"'), 2)


if __name__ == "__main__":
    rostest.rosrun("occusg", "shutdown_test", ShutdownTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of the pipeline given to the nodes reach the core; others are named."""
import os
import signal
import subprocess
import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import OccupancyGrid
from occusg.srv import ListRooms
from std_msgs.msg import String

from robot import Robot, camera_info, two_rooms, wait_until


class ParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("parameters_test")
        cls.robot = Robot()

    def start(self, node, name, parameters, *remappings):
        for key, value in parameters.items():
            rospy.set_param("/%s/%s" % (name, key), value)
        rospy.set_param("/%s/save_on_exit" % name, False)
        process = subprocess.Popen(
            [os.path.join(rospy.get_param("~programs"), node), "__name:=" + name] +
            list(remappings), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            universal_newlines=True)
        self.addCleanup(process.kill)
        return process

    @staticmethod
    def said_until_the_end(process):
        process.send_signal(signal.SIGINT)
        return process.communicate(timeout=20)[0]

    def test_mapping_uses_the_resolution_it_is_given(self):
        process = self.start("mapping", "coarse", {"mapping/occupancy/resolution_m": 0.2},
                             "depth/image_rect:=/camera/depth/image_rect",
                             "depth/camera_info:=/camera/depth/camera_info")
        layers = []
        rospy.Subscriber("/free_space", OccupancyGrid, layers.append)
        config = rospy.wait_for_message("/coarse/config", String, 20).data
        self.assertIn("resolution_m: 0.2", config)
        self.robot.wait_for_subscribers(self.robot.depth_publisher, self.robot.info_publisher,
                                        self.robot.tf_publisher)

        def is_mapped():
            self.robot.info_publisher.publish(camera_info())
            self.robot.send_frame(rospy.Time.now())
            return layers and layers[-1].info.width > 0
        wait_until(is_mapped, 30, "free space")
        self.assertAlmostEqual(layers[-1].info.resolution, 0.2, places=6)
        self.said_until_the_end(process)

    def test_scene_graph_uses_the_parameters_it_is_given(self):
        # The door is wider than a door may be then: the two rooms are one.
        process = self.start("scene_graph", "wide", {
            "mapping_node": "", "regions/decomposer": "constriction",
            "regions/constriction/widest_door_m": 0.5}, "free_space:=/map")
        publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        self.robot.wait_for_subscribers(publisher, self.robot.tf_publisher)
        publisher.publish(two_rooms(rospy.Time.now()))

        def rooms():
            self.robot.send_pose(rospy.Time.now(), 1.0, 2.0)
            try:
                return rospy.ServiceProxy("/list_rooms", ListRooms)(0.0).rooms
            except rospy.ServiceException:
                return []
        wait_until(rooms, 30, "a room")
        self.assertEqual([round(room.area) for room in rooms()], [32], "both rooms are one")
        self.said_until_the_end(process)

    def test_unknown_parameter_is_named_with_the_nearest_known_one(self):
        process = self.start("mapping", "mistyped", {"mapping/occupancy/resolutoin_m": 0.2})
        rospy.wait_for_message("/mistyped/config", String, 20)
        said = [line for line in self.said_until_the_end(process).splitlines()
                if "resolutoin_m" in line]
        self.assertEqual(len(said), 1)
        self.assertIn("~mapping/occupancy/resolutoin_m is not a parameter; did you mean "
                      "~mapping/occupancy/resolution_m?", said[0])

    def test_values_that_are_not_allowed_are_all_named_and_end_the_node(self):
        wrong = {"mapping": {"mapping/occupancy/resolution_m": -1.0, "queue_size": "many"},
                 "scene_graph": {"mapping/occupancy/resolution_m": -1.0},
                 "semantics": {"perception/model/max_iou": 5.0}}
        for node, parameters in wrong.items():
            process = self.start(node, "impossible_" + node, parameters)
            said = process.communicate(timeout=30)[0]
            self.assertNotEqual(process.returncode, 0, said)
            self.assertIn("does not start", said)
            for name in parameters:
                self.assertIn("~" + name, said)

    def test_transport_without_a_plugin_ends_the_node_with_those_that_are_there(self):
        process = self.start("mapping", "no_transport", {"image_transport": "pigeon"})
        said = process.communicate(timeout=30)[0]
        self.assertNotEqual(process.returncode, 0, said)
        self.assertIn("~image_transport: is 'pigeon'", said)
        self.assertIn("image_transport/raw", said)


if __name__ == "__main__":
    rostest.rosrun("occusg", "parameters_test", ParametersTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two robots in namespaces; the maps of others: probabilities, and parts that change a map."""
import random
import sys
import unittest

import rospy
import rostest
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid
from occusg.msg import RoomArray
from occusg.srv import SegmentMap
from tf2_msgs.msg import TFMessage

from robot import Robot, transform, two_rooms, wait_until

UPRIGHT = (0.0, 0.0, 0.0, 1.0)


def as_probabilities(grid):
    """The same map as cartographer gives it: floor 12..34, walls 66..90."""
    random.seed(1)
    grid.data = [value if value < 0 else random.randint(66, 90) if value == 100 else random.randint(12, 34)
                 for value in grid.data]
    return grid


class MapsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("maps_test")
        cls.robot = Robot()
        cls.rooms = {}
        cls.maps = {}
        cls.updates = {}
        for name in ("robot1", "robot2"):
            rospy.Subscriber(f"/{name}/occusg/rooms", RoomArray, cls.take_rooms, name)
            cls.maps[name] = rospy.Publisher(f"/{name}/map", OccupancyGrid, queue_size=1, latch=True)
            cls.updates[name] = rospy.Publisher(f"/{name}/map_updates", OccupancyGridUpdate, queue_size=5)
        cls.walk = rospy.Timer(rospy.Duration(0.1), lambda _: cls.stand())
        rospy.on_shutdown(cls.walk.shutdown)
        cls.robot.wait_for_subscribers(*cls.maps.values(), *cls.updates.values(), cls.robot.tf_publisher)

    @classmethod
    def take_rooms(cls, rooms, name):
        cls.rooms[name] = [room.area for room in rooms.rooms]

    @classmethod
    def stand(cls):
        now = rospy.Time.now()
        cls.robot.tf_publisher.publish(TFMessage([
            transform(now, "map", f"{name}/base_link", (1.0, 2.0, 0.0), UPRIGHT) for name in cls.maps]))

    def wait_for_rooms(self, name, count):
        wait_until(lambda: len(self.rooms.get(name, [])) == count, 30,
                   lambda: f"{count} rooms of {name}; there are {self.rooms.get(name)}")

    def test_each_robot_has_the_rooms_of_its_own_map(self):
        self.maps["robot1"].publish(as_probabilities(two_rooms(rospy.Time.now())))
        self.wait_for_rooms("robot1", 2)
        for area in self.rooms["robot1"]:
            self.assertAlmostEqual(area, 16.0, delta=1.5)

        # The second robot has seen one room; a part of the map brings the other.
        whole = two_rooms(rospy.Time.now())
        width, height = whole.info.width, whole.info.height
        half = width // 2
        first = two_rooms(rospy.Time.now())
        first.data = [int(value) if i % width < half else -1 for i, value in enumerate(whole.data)]
        self.maps["robot2"].publish(first)
        self.wait_for_rooms("robot2", 1)
        part = OccupancyGridUpdate()
        part.header.stamp = rospy.Time.now()
        part.header.frame_id = whole.header.frame_id
        part.x, part.y, part.width, part.height = half, 0, width - half, height
        part.data = [whole.data[y * width + x] for y in range(height) for x in range(half, width)]
        self.updates["robot2"].publish(part)
        self.wait_for_rooms("robot2", 2)
        self.assertEqual(len(self.rooms["robot1"]), 2)

    def test_segment_map_reads_probabilities_and_says_so(self):
        rospy.wait_for_service("/robot1/occusg/segment_map", 30)
        segment = rospy.ServiceProxy("/robot1/occusg/segment_map", SegmentMap)
        answer = segment(map=as_probabilities(two_rooms(rospy.Time.now())), decomposer="")
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(len(answer.regions), 2)
        self.assertIn("probabilities", answer.message)


if __name__ == "__main__":
    rostest.rosrun("occusg", "maps", MapsTest, sys.argv)

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A robot with a laser map for each storey, which rides a lift and then gets the other map."""
import sys
import unittest

import rospy
import rostest
from nav_msgs.msg import OccupancyGrid
from occusg.msg import CurrentRoom, RoomArray, StoreyArray
from occusg.srv import GetPath, SetStorey

from robot import Robot, two_rooms, wait_until

UPPER_FLOOR_M = 4.0
LIFT = (7.0, 2.0)


class LiftTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("lift_test")
        cls.robot = Robot()
        cls.newest = {}
        for topic, kind in (("rooms", RoomArray), ("storeys", StoreyArray),
                            ("current_room", CurrentRoom)):
            rospy.Subscriber("/occusg/" + topic, kind,
                             lambda message, name=topic: cls.newest.update({name: message}))
        cls.map_publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        cls.place = (1.0, 2.0)
        cls.walk = rospy.Timer(rospy.Duration(0.1), lambda _: cls.robot.send_pose(
            rospy.Time.now(), *cls.place))
        rospy.on_shutdown(cls.walk.shutdown)
        cls.robot.wait_for_subscribers(cls.map_publisher, cls.robot.tf_publisher)
        cls.map_publisher.publish(two_rooms(rospy.Time.now()))
        wait_until(lambda: len(cls.rooms_of(0)) == 2, 30, "two rooms downstairs")
        cls.ride()

    @classmethod
    def rooms_of(cls, floor_id):
        rooms = cls.newest["rooms"].rooms if "rooms" in cls.newest else []
        return sorted((room for room in rooms if room.floor_id == floor_id), key=lambda r: r.id)

    @classmethod
    def set_storey(cls, floor_id, floor_z=0.0):
        rospy.wait_for_service("/occusg/set_storey", 30)
        return rospy.ServiceProxy("/occusg/set_storey", SetStorey)(floor_id, floor_z)

    @classmethod
    def room_of(cls, floor_id, x):
        """The room of a storey that x lies in."""
        return next(room for room in cls.rooms_of(floor_id) if abs(room.position.x - x) < 2.0)

    @classmethod
    def ride(cls):
        """Into the lift, up, and to the map of the upper storey; its frame is that of the lower."""
        cls.place = LIFT
        east = cls.room_of(0, LIFT[0]).id
        wait_until(lambda: cls.newest["current_room"].id == east, 20, "the robot is in the lift")
        answer = cls.set_storey(1, UPPER_FLOOR_M)
        assert answer.success, answer.message
        cls.map_publisher.publish(two_rooms(rospy.Time.now()))
        wait_until(lambda: len(cls.rooms_of(1)) == 2, 30, lambda: "two rooms upstairs: %s"
                   % cls.newest["rooms"])

    def test_both_storeys_stay_in_one_graph_with_a_lift_between_them(self):
        self.assertEqual(len(self.rooms_of(0)), 2)
        for room in self.rooms_of(1):
            self.assertAlmostEqual(room.position.z, UPPER_FLOOR_M)
        storeys = self.newest["storeys"]
        self.assertEqual([storey.floor_z for storey in storeys.storeys], [0.0, UPPER_FLOOR_M])
        self.assertEqual([stairs.kind for stairs in storeys.stairs], ["lift"])
        self.assertEqual(list(storeys.stairs[0].rooms),
                         [self.room_of(0, LIFT[0]).id, self.room_of(1, LIFT[0]).id])

    def test_robot_is_in_a_room_of_the_storey_it_rode_to(self):
        upstairs = self.room_of(1, LIFT[0]).id
        wait_until(lambda: self.newest["current_room"].id == upstairs, 20, "the robot is upstairs")
        self.assertEqual(self.newest["current_room"].floor_id, 1)

    def test_path_leads_through_the_lift(self):
        first, last = self.room_of(0, 2.0).id, self.room_of(1, 2.0).id
        way = rospy.ServiceProxy("/occusg/get_path", GetPath)(first, last)
        self.assertTrue(way.success, way.message)
        self.assertEqual([stairs.kind for stairs in way.stairs], ["lift"])
        self.assertEqual((way.rooms[0], way.rooms[-1]), (first, last))

    def test_storey_that_cannot_be_is_refused_in_one_sentence(self):
        for floor_id, floor_z in ((7, 30.0), (-1, 0.0), (2, UPPER_FLOOR_M + 0.3),
                                  (2, float("nan"))):
            answer = self.set_storey(floor_id, floor_z)
            self.assertFalse(answer.success)
            self.assertIn("floor_", answer.message)

    def test_way_back_finds_the_rooms_under_their_ids(self):
        before = [room.id for room in self.rooms_of(0)]
        self.assertTrue(self.set_storey(0).success)
        self.map_publisher.publish(two_rooms(rospy.Time.now()))
        below = self.room_of(0, LIFT[0]).id
        wait_until(lambda: self.newest["current_room"].id == below, 20, "the robot is downstairs")
        self.assertEqual([room.id for room in self.rooms_of(0)], before)
        self.assertEqual(len(self.newest["storeys"].stairs), 1, "the same lift")


if __name__ == "__main__":
    rostest.rosrun("occusg", "lift", LiftTest, sys.argv)

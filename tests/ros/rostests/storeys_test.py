#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A depth camera that is carried up a stair: both storeys are in one graph, joined by the stair."""
import json
import os
import shutil
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from occusg.msg import CurrentRoom, RegionArray, RoomArray, StoreyArray
from occusg.srv import GetPath, GetRoomAt, LoadMap, SaveMap
from visualization_msgs.msg import MarkerArray

from house import CAMERA_ABOVE_FLOOR_M, UPPER_FLOOR_M, depth_from, tour_of_both_storeys
from robot import (BODY_TO_OPTICAL, CAMERA_FRAME, Diagnostics, Robot, camera_info, depth_image,
                   multiplied, quaternion, transform, wait_until)
from tf2_msgs.msg import TFMessage

FRAME_S = 0.2
START_S = 1000.0


class StoreysTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("storeys_test")
        cls.robot = Robot(clock=True)
        cls.mapping = Diagnostics("/mapping: mapping")
        cls.shown = {}
        cls.newest = {}
        for topic, kind in (("rooms", RoomArray), ("storeys", StoreyArray),
                            ("regions", RegionArray), ("current_room", CurrentRoom),
                            ("free_space", OccupancyGrid)):
            rospy.Subscriber("/occusg/" + topic, kind,
                             lambda message, name=topic: cls.newest.update({name: message}))
        rospy.Subscriber("/occusg/markers", MarkerArray, cls.take_markers)
        cls.robot.wait_for_subscribers(cls.robot.depth_publisher, cls.robot.info_publisher,
                                       cls.robot.tf_publisher)
        cls.drive()
        wait_until(lambda: len(cls.rooms()) == 4, 60, lambda: "four rooms: %s" % cls.newest)

    @classmethod
    def take_markers(cls, array):
        for marker in array.markers:
            cls.shown[marker.ns, marker.id] = marker

    @classmethod
    def rooms(cls):
        return cls.newest["rooms"].rooms if "rooms" in cls.newest else []

    @classmethod
    def send_pose(cls, stamp, x, y, z, yaw):
        body = quaternion(yaw)
        cls.robot.tf_publisher.publish(TFMessage(transforms=[
            transform(stamp, "map", "base_link", (x, y, z), body),
            transform(stamp, "map", CAMERA_FRAME, (x, y, z + CAMERA_ABOVE_FLOOR_M),
                      multiplied(body, BODY_TO_OPTICAL))]))

    @classmethod
    def drive(cls):
        cls.robot.set_clock(rospy.Time(START_S))
        wait_until(lambda: rospy.Time.now() == rospy.Time(START_S), 10, "the clock runs")
        cls.robot.info_publisher.publish(camera_info())
        poses = tour_of_both_storeys()
        for i, (x, y, z, yaw) in enumerate(poses):
            stamp = rospy.Time(START_S + FRAME_S * i)
            cls.robot.set_clock(stamp)
            cls.send_pose(stamp, x, y, z, yaw)
            image = depth_image(stamp, depth_from((x, y, z + CAMERA_ABOVE_FLOOR_M), yaw))
            cls.robot.depth_publisher.publish(image)
            if i % 20 == 19:
                cls.mapping.wait_for("images used", i - 5, 60)
        cls.stand(poses[-1], START_S + FRAME_S * len(poses), 10.0)

    @classmethod
    def stand(cls, pose, from_s, seconds):
        """The robot stays there while time passes: rooms of both storeys are maintained."""
        for i in range(int(seconds / FRAME_S)):
            stamp = rospy.Time(from_s + FRAME_S * i)
            cls.robot.set_clock(stamp)
            cls.send_pose(stamp, *pose)
            rospy.rostime.wallsleep(0.02)

    def on_storey(self, floor_id):
        return [room for room in self.rooms() if room.floor_id == floor_id]

    def room_at(self, x, y, z):
        place = PointStamped()
        place.point.x, place.point.y, place.point.z = x, y, z
        answer = rospy.ServiceProxy("/occusg/get_room_at", GetRoomAt)(place)
        self.assertTrue(answer.success, answer.message)
        return answer.room

    def test_storeys_and_the_stair_between_them_are_told(self):
        storeys = self.newest["storeys"]
        self.assertEqual([storey.floor_id for storey in storeys.storeys], [0, 1])
        for storey, floor_z in zip(storeys.storeys, (0.0, UPPER_FLOOR_M)):
            self.assertAlmostEqual(storey.floor_z, floor_z, delta=0.15)
        self.assertEqual(storeys.current, 1)
        self.assertEqual(len(storeys.stairs), 1)
        stair = storeys.stairs[0]
        self.assertEqual((stair.kind, tuple(stair.floor_ids)), ("stairs", (0, 1)))
        self.assertEqual(list(stair.rooms), [self.room_at(6.0, 1.0, 0.0).id,
                                             self.room_at(6.0, 1.0, UPPER_FLOOR_M).id])

    def test_rooms_lie_on_the_floors_of_their_storeys(self):
        for floor_id, floor_z in ((0, 0.0), (1, UPPER_FLOOR_M)):
            rooms = self.on_storey(floor_id)
            self.assertEqual(len(rooms), 2)
            for room in rooms:
                self.assertAlmostEqual(room.position.z, floor_z, delta=0.15)
                self.assertAlmostEqual(room.polygon.outer.points[0].z, floor_z, delta=0.15)
                self.assertTrue(all(other.floor_id == floor_id for other in self.rooms()
                                    if other.id in room.adjacent), "no edge through the slab")
        self.assertEqual(self.newest["current_room"].floor_id, 1)
        regions = self.newest["regions"].regions
        self.assertEqual(sorted({region.floor_id for region in regions}), [0, 1])
        self.assertEqual(len({region.id for region in regions}), len(regions))

    def test_height_tells_the_room_at_a_place(self):
        below, above = self.room_at(2.0, 2.0, 0.1), self.room_at(2.0, 2.0, UPPER_FLOOR_M + 0.1)
        self.assertEqual((below.floor_id, above.floor_id), (0, 1))

    def test_each_storey_has_a_latched_map(self):
        for floor_id, floor_z in ((0, 0.0), (1, UPPER_FLOOR_M)):
            grid = rospy.wait_for_message("/occusg/free_space/%d" % floor_id, OccupancyGrid, 20)
            self.assertAlmostEqual(grid.info.origin.position.z, floor_z, delta=0.15)
            self.assertGreater(grid.data.count(0) * grid.info.resolution ** 2, 20.0)
        self.assertAlmostEqual(self.newest["free_space"].info.origin.position.z, UPPER_FLOOR_M,
                               delta=0.15, msg="that of the storey the robot is on")

    def test_path_from_storey_to_storey_leads_over_the_stair(self):
        first, last = self.room_at(2.0, 2.0, 0.0).id, self.room_at(2.0, 2.0, UPPER_FLOOR_M).id
        way = rospy.ServiceProxy("/occusg/get_path", GetPath)(first, last)
        self.assertTrue(way.success, way.message)
        self.assertEqual([stair.kind for stair in way.stairs], ["stairs"])
        self.assertEqual((way.rooms[0], way.rooms[-1]), (first, last))
        self.assertEqual(len(way.rooms), 4)
        heights = [pose.pose.position.z for pose in way.path.poses]
        self.assertAlmostEqual(heights[0], 0.0, delta=0.15)
        self.assertAlmostEqual(heights[-1], UPPER_FLOOR_M, delta=0.15)

    def test_markers_show_both_floors_and_the_stair(self):
        floors = [marker.points[0].z for (name, _), marker in self.shown.items()
                  if name == "room_floors"]
        self.assertEqual(sorted(round(z) for z in floors), [0, 0, 3, 3])
        self.assertEqual(sum(name == "stairs" for name, _ in self.shown), 1)

    def test_saved_house_comes_back_with_its_storeys(self):
        saved = rospy.ServiceProxy("/occusg/scene_graph/save", SaveMap)("house")
        self.assertTrue(saved.success, saved.message)
        try:
            with open(os.path.join(saved.folder, "rooms.json")) as file:
                rooms = json.load(file)
            self.assertEqual(len(rooms["storeys"]), 2)
            self.assertEqual(len(rooms["stairs"]), 1)
            before = sorted((room.id, room.floor_id) for room in self.rooms())
            loaded = rospy.ServiceProxy("/occusg/scene_graph/load", LoadMap)("house")
            self.assertTrue(loaded.success, loaded.message)
            wait_until(lambda: sorted((room.id, room.floor_id) for room in self.rooms()) == before,
                       20, "the rooms of both storeys under their ids")
            for floor_id in (0, 1):
                rospy.wait_for_message("/occusg/free_space/%d" % floor_id, OccupancyGrid, 20)
        finally:
            shutil.rmtree(saved.folder)

    def test_failure_mode_17_half_a_map_is_refused_and_rooms_and_map_stay(self):
        saved = rospy.ServiceProxy("/occusg/scene_graph/save", SaveMap)("half")
        self.assertTrue(saved.success, saved.message)
        try:
            before = sorted(room.id for room in self.rooms())
            cells = rospy.wait_for_message("/occusg/free_space/0", OccupancyGrid, 20).data
            path = os.path.join(saved.folder, "map.ot")
            os.truncate(path, os.path.getsize(path) // 2)
            loaded = rospy.ServiceProxy("/occusg/scene_graph/load", LoadMap)("half")
            self.assertFalse(loaded.success)
            self.assertIn("map.ot", loaded.message)
            self.assertEqual(sorted(room.id for room in self.rooms()), before)
            layer = rospy.wait_for_message("/occusg/free_space/0", OccupancyGrid, 20)
            self.assertEqual(layer.data, cells)
        finally:
            shutil.rmtree(saved.folder)

    def test_failure_mode_17_few_bytes_that_stand_for_a_building_are_refused_at_once(self):
        saved = rospy.ServiceProxy("/occusg/scene_graph/save", SaveMap)("bomb")
        self.assertTrue(saved.success, saved.message)
        try:
            shutil.rmtree(os.path.join(saved.folder, "session"))
            # One free leaf of 2048 voxels a side.
            with open(os.path.join(saved.folder, "map.ot"), "wb") as file:
                file.write(b"# Octomap OcTree binary file\nid OcTree\nsize 6\nres 0.05\ndata\n" +
                           bytes([3, 0] * 4 + [1, 0]))
            started = time.monotonic()
            loaded = rospy.ServiceProxy("/occusg/mapping/load", LoadMap)("bomb")
            self.assertFalse(loaded.success)
            self.assertIn("map.ot", loaded.message)
            self.assertLess(time.monotonic() - started, 5.0)
        finally:
            shutil.rmtree(saved.folder)


if __name__ == "__main__":
    rostest.rosrun("occusg", "storeys", StoreysTest, sys.argv)

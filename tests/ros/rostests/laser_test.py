#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A robot that only has a laser map: nav_msgs/OccupancyGrid straight into the scene graph."""
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import OccupancyGrid
from nodelet.srv import NodeletList, NodeletUnload
from occusg.msg import (CurrentRoom, DetectionArray, DetectionInfo, RegionArray, RoomArray,
                        SceneGraphStamped, SceneGraphUpdate)
from occusg.srv import (GetPath, GetRoomAt, GetSceneGraph, ListRooms, SaveMap, SegmentMap,
                        SetRoomLabel)
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from robot import Diagnostics, Robot, transform, two_rooms, wait_until


class LaserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("laser_test")
        cls.robot = Robot()
        cls.diagnostics = Diagnostics("/scene_graph: scene graph")
        cls.map_publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        cls.place = (1.0, 2.0)
        cls.updates = []
        cls.regions = []
        cls.current = None
        rospy.Subscriber("/occusg/scene_graph_updates", SceneGraphUpdate, cls.updates.append)
        rospy.Subscriber("/occusg/regions", RegionArray, cls.regions.append)
        rospy.Subscriber("/occusg/current_room", CurrentRoom, cls.take_current)
        cls.walk = rospy.Timer(rospy.Duration(0.1), lambda _: cls.robot.send_pose(
            rospy.Time.now(), *cls.place))
        rospy.on_shutdown(cls.walk.shutdown)
        cls.robot.wait_for_subscribers(cls.map_publisher, cls.robot.tf_publisher)
        # As a map_server does: once, and long ago.
        cls.map_publisher.publish(two_rooms(rospy.Time.now() - rospy.Duration(500)))
        wait_until(lambda: len(cls.rooms()) == 2, 30, "two rooms")

    @classmethod
    def take_current(cls, current):
        cls.current = current

    @staticmethod
    def rooms(min_area=0.0):
        rospy.wait_for_service("/occusg/list_rooms", 30)
        return rospy.ServiceProxy("/occusg/list_rooms", ListRooms)(min_area).rooms

    def room_at(self, x, y, frame=""):
        place = PointStamped()
        place.header.frame_id = frame
        place.point.x, place.point.y = x, y
        return rospy.ServiceProxy("/occusg/get_room_at", GetRoomAt)(place)

    def test_rooms_of_the_map_are_found(self):
        rooms = self.rooms()
        for room in rooms:
            self.assertAlmostEqual(room.area, 16.0, delta=1.5)
        self.assertEqual(rooms[0].adjacent, (rooms[1].id,))
        self.assertEqual(rooms[0].reason, "bootstrap")
        self.assertEqual(self.rooms(min_area=100.0), [])

    def test_robot_that_walks_over_changes_its_room(self):
        first = self.room_at(1.0, 2.0).room.id
        second = self.room_at(6.0, 2.0).room.id
        self.assertNotEqual(first, second)
        type(self).place = (6.0, 2.0)
        wait_until(lambda: self.current and self.current.id == second, 15, "the robot is there")
        type(self).place = (1.0, 2.0)
        wait_until(lambda: self.current and self.current.id == first, 15, "the robot is back")

    def test_get_room_at(self):
        self.assertTrue(self.room_at(1.0, 1.0).success)
        self.assertTrue(self.room_at(0.0, 0.0, "base_link").success, "where the robot is")
        self.assertFalse(self.room_at(99.0, 1.0).success)
        self.assertFalse(self.room_at(float("nan"), 1.0).success)
        self.assertIn("map <- nowhere", self.room_at(1.0, 1.0, "nowhere").message)

    def test_get_path(self):
        path = rospy.ServiceProxy("/occusg/get_path", GetPath)
        first, second = (room.id for room in self.rooms())
        way = path(first, second)
        self.assertTrue(way.success, way.message)
        self.assertEqual(list(way.rooms), [first, second])
        self.assertAlmostEqual(way.doors[0].width, 1.0, delta=0.2)
        self.assertGreater(way.length, 3.0)
        self.assertEqual(way.path.header.frame_id, "map")
        self.assertFalse(path(first, 77).success)
        numbers = [room.number for room in self.rooms()]
        self.assertEqual(list(path(*numbers).rooms), [first, second], "numbers mean the same rooms")

    def test_set_room_label(self):
        label = rospy.ServiceProxy("/occusg/set_room_label", SetRoomLabel)
        room = self.rooms()[1].id
        self.assertTrue(label(room, "kitchen").success)
        self.assertEqual(self.rooms()[1].label, "kitchen")
        # Maintenance, which labels rooms, publishes the regions.
        maintained = len(self.regions)
        wait_until(lambda: len(self.regions) >= maintained + 2, 20, "maintenance, twice")
        self.assertEqual(self.rooms()[1].label, "kitchen", "it stays")
        self.assertFalse(label(77, "kitchen").success)
        self.assertTrue(label(self.rooms()[1].number, "Küche").success)
        self.assertEqual(self.rooms()[1].label, "Küche")
        self.assertFalse(label(room, "a\nb").success)
        self.assertFalse(label(room, "x" * 65).success)

    def test_updates_lead_from_one_graph_to_the_next(self):
        graph = rospy.ServiceProxy("/occusg/get_scene_graph", GetSceneGraph)
        room = self.rooms()[0].id
        before = graph().graph
        del self.updates[:]
        rospy.ServiceProxy("/occusg/set_room_label", SetRoomLabel)(room, "office")
        wait_until(lambda: any(u.rooms for u in self.updates), 5, "an update")
        update = next(u for u in self.updates if u.rooms)
        self.assertEqual(update.sequence, update.previous_sequence + 1)
        self.assertGreaterEqual(update.previous_sequence, before.sequence)
        self.assertEqual([r.id for r in update.rooms], [room])
        self.assertEqual(update.removed_nodes, ())
        self.assertGreaterEqual(graph().graph.sequence, update.sequence)

    def test_failure_mode_11_maps_that_cannot_be_used_are_refused(self):
        self.diagnostics.wait_for_news()
        key = "dropped: refused_by_map"
        publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=10)
        self.robot.wait_for_subscribers(publisher)
        for change in ("resolution", "size", "value"):
            grid = two_rooms(rospy.Time.now())
            if change == "resolution":
                grid.info.resolution = float("nan")
            elif change == "size":
                grid.data = grid.data[:-1]
            else:
                grid.data[5] = 101
            before = self.diagnostics.count(key)
            publisher.publish(grid)
            self.diagnostics.wait_for(key, before + 1)
        other = two_rooms(rospy.Time.now(), frame="odom")
        publisher.publish(other)
        self.diagnostics.wait_for("dropped: bad_image", 1)
        self.map_publisher.publish(two_rooms(rospy.Time.now()))
        self.assertEqual(len(self.rooms()), 2)

    def test_failure_mode_06_stamps_from_the_future_are_refused_and_time_goes_on(self):
        future = rospy.Time(4294967295, 0)
        before = self.diagnostics.count("dropped: bad_stamp")
        publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=10)
        detections = rospy.Publisher("/occusg/detections", DetectionArray, queue_size=10)
        self.robot.wait_for_subscribers(publisher, detections)
        publisher.publish(two_rooms(future))
        array = DetectionArray(detections=[DetectionInfo()])
        array.header.stamp, array.header.frame_id = future, "map"
        detections.publish(array)
        tf = transform(future, "map", "from_the_future", (1.0, 2.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        self.robot.tf_publisher.publish(TFMessage([tf]))
        self.diagnostics.wait_for("dropped: bad_stamp", max(before, 0) + 2)
        # Maintenance, which follows logical time, publishes the regions.
        maintained = len(self.regions)
        wait_until(lambda: len(self.regions) >= maintained + 2, 20, "maintenance, twice")
        self.assertLess(self.regions[-1].header.stamp, rospy.Time.now() + rospy.Duration(6))
        self.assertEqual(len(self.rooms()), 2)

    def test_failure_mode_12_detections_are_refused_one_by_one_and_capped(self):
        publisher = rospy.Publisher("/occusg/detections", DetectionArray, queue_size=10)
        self.robot.wait_for_subscribers(publisher)
        broken = DetectionInfo(score=float("nan"))
        publisher.publish(DetectionArray(detections=[broken] * 3 + [DetectionInfo()] * 5000))
        self.diagnostics.wait_for("detections refused", 3 + 5003 - 1000)

    def test_segment_map(self):
        segment = rospy.ServiceProxy("/occusg/segment_map", SegmentMap)
        grid = two_rooms(rospy.Time.now())
        for decomposer in ("", "constriction"):
            answer = segment(grid, decomposer)
            self.assertTrue(answer.success, answer.message)
            self.assertEqual(len(answer.regions), 2, decomposer)
            self.assertEqual(answer.segmented_map.encoding, "32SC1")
            self.assertEqual(answer.segmented_map.width, grid.info.width)
            self.assertEqual(len(answer.doors), 1)
        self.assertTrue(segment(grid, "dude").success)
        self.assertFalse(segment(grid, "magic").success)
        grid.info.resolution = 0.0
        self.assertFalse(segment(grid, "").success)

    def test_late_subscriber_sees_everything(self):
        markers, graphs, rooms = [], [], []
        rospy.Subscriber("/occusg/markers", MarkerArray, markers.append)
        rospy.Subscriber("/occusg/scene_graph", SceneGraphStamped, graphs.append)
        rospy.Subscriber("/occusg/rooms", RoomArray, rooms.append)
        wait_until(lambda: markers and graphs and rooms, 10, "all topics")
        self.assertEqual(len(rooms[0].rooms), 2)
        self.assertEqual(len(graphs[0].rooms), 2)
        layers = {marker.ns for marker in markers[0].markers}
        self.assertLessEqual({"rooms", "room_floors", "room_labels", "adjacency", "doors"}, layers)
        self.assertEqual({marker.action for marker in markers[0].markers}, {Marker.ADD})

    def test_failure_mode_18_save_takes_a_name_and_never_a_path(self):
        save = rospy.ServiceProxy("/occusg/scene_graph/save", SaveMap)
        self.assertFalse(save("../x").success)
        answer = save("laser_test")
        self.assertTrue(answer.success, answer.message)
        with open(answer.folder + "/rooms.json") as written:
            self.assertIn("polygon", written.read())

    def test_failure_mode_20_nodelet_is_unloaded_and_loaded_again(self):
        listed = rospy.ServiceProxy("/occusg/manager/list", NodeletList)
        unload = rospy.ServiceProxy("/occusg/manager/unload_nodelet", NodeletUnload)
        started = time.monotonic()
        self.assertTrue(unload("/occusg/scene_graph").success)
        self.assertLess(time.monotonic() - started, 2.0)
        wait_until(lambda: "/occusg/scene_graph" in listed().nodelets, 30, "it is loaded again")
        # While maps arrive: a manager may unload a nodelet in the middle of one of its callbacks.
        for _ in range(3):
            wait_until(lambda: len(self.rooms()) == 2, 30, "two rooms again")
            for _ in range(20):
                self.map_publisher.publish(two_rooms(rospy.Time.now()))
            unload("/occusg/scene_graph")
            wait_until(lambda: "/occusg/scene_graph" in listed().nodelets, 30, "it is loaded again")
        wait_until(lambda: len(self.rooms()) == 2, 30, "two rooms again")

    def test_zz_pause_and_reset(self):
        pause = rospy.ServiceProxy("/occusg/scene_graph/pause", SetBool)
        self.assertTrue(pause(True).success)
        self.assertTrue(rospy.ServiceProxy("/occusg/scene_graph/reset", Trigger)().success)
        self.assertEqual(self.rooms(), [])
        self.assertTrue(pause(False).success)
        self.map_publisher.publish(two_rooms(rospy.Time.now()))
        wait_until(lambda: len(self.rooms()) == 2, 30, "two rooms again")


if __name__ == "__main__":
    rostest.rosrun("occusg", "laser_test", LaserTest, sys.argv)

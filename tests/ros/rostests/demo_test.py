#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The project's own recording through the nodelets ends with the rooms of `occusg run`."""
import itertools
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
import rospy
import rostest
from dynamic_reconfigure.client import Client
from occusg.msg import RoomArray, SceneGraphStamped, SceneGraphUpdate
from nav_msgs.msg import OccupancyGrid
from occusg.srv import GetPath, GetSceneGraph, LoadMap, SaveMap
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import Marker, MarkerArray

from robot import Diagnostics, wait_until

FRAMES = 314
LAST_STAMP_S = 1000.0 + 62.6  # occusg_play begins at 1000 s
HOLD_S = 12.0
CELL_M = 0.025
ROBOT_RADIUS_M = 0.2

LATE_SUBSCRIBER = """
import json, rospy
from visualization_msgs.msg import MarkerArray
rospy.init_node("late_subscriber", anonymous=True)
markers = rospy.wait_for_message("/occusg/markers", MarkerArray, 20).markers
print(json.dumps([(marker.ns, marker.id) for marker in markers]))
"""


def raster(rings, low, shape):
    """Cells of a grid whose centres the rings hold: even-odd."""
    y, x = numpy.mgrid[:shape[0], :shape[1]]
    x, y = low[0] + (x + 0.5) * CELL_M, low[1] + (y + 0.5) * CELL_M
    inside = numpy.zeros(shape, dtype=bool)
    for ring in rings:
        for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
            if y0 == y1:
                continue
            crosses = (y0 > y) != (y1 > y)
            inside ^= crosses & (x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
    return inside


def overlap(a, b):
    points = numpy.array([point for ring in a + b for point in ring])
    low = points.min(axis=0)
    shape = tuple(numpy.ceil((points.max(axis=0) - low) / CELL_M).astype(int)[::-1] + 1)
    first, second = raster(a, low, shape), raster(b, low, shape)
    return (first & second).sum() / max(1, (first | second).sum())


def rings_of(polygon):
    return [[(p.x, p.y) for p in ring.points] for ring in [polygon.outer] + polygon.holes]


def later_recording(sequence, seconds, frames=20):
    """The first frames of a recording, so many seconds later."""
    folder = tempfile.mkdtemp(prefix="occusg_later_")
    for name in os.listdir(sequence):
        source, target = os.path.join(sequence, name), os.path.join(folder, name)
        if name not in ("depth.txt", "groundtruth.txt"):
            os.symlink(source, target)
            continue
        with open(source) as lines, open(target, "w") as shifted:
            rows = [line.split(" ", 1) for line in lines if not line.startswith("#")]
            shifted.writelines("%.6f %s" % (float(stamp) + seconds, rest)
                               for stamp, rest in rows[:frames])
    return folder


class DemoTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("demo_test")
        cls.rooms, cls.graph, cls.clock_s = None, None, 0.0
        cls.nodes, cls.gaps, cls.sequence = {}, 0, 0
        cls.shown = {}
        cls.mapping = Diagnostics("/mapping: mapping")
        rospy.Subscriber("/clock", Clock, cls.take_clock, queue_size=1)
        rospy.Subscriber("/occusg/rooms", RoomArray, lambda m: setattr(cls, "rooms", m))
        rospy.Subscriber("/occusg/scene_graph", SceneGraphStamped,
                         lambda m: setattr(cls, "graph", m))
        rospy.Subscriber("/occusg/scene_graph_updates", SceneGraphUpdate, cls.take_update)
        rospy.Subscriber("/occusg/markers", MarkerArray, cls.take_markers)
        wait_until(lambda: cls.clock_s >= LAST_STAMP_S + HOLD_S - 0.2, 150, "the recording has ended")

    @classmethod
    def take_clock(cls, clock):
        cls.clock_s = clock.clock.to_sec()

    @classmethod
    def take_update(cls, update):
        """As SceneGraphUpdate tells: whoever does not hold what it starts from asks for all."""
        if cls.sequence == 0 and update.previous_sequence > 0:
            cls.take_whole()
        if update.sequence <= cls.sequence:
            return
        if update.previous_sequence != cls.sequence:
            cls.gaps += 1
        cls.sequence = update.sequence
        for node in update.removed_nodes:
            cls.nodes.pop(node, None)
        for node in update.rooms + update.agents + update.objects + update.navigation:
            cls.nodes[node.id] = node

    @classmethod
    def take_whole(cls):
        graph = rospy.ServiceProxy("/occusg/get_scene_graph", GetSceneGraph)().graph
        cls.sequence = graph.sequence
        cls.nodes = cls.nodes_of(graph)

    @staticmethod
    def nodes_of(graph):
        return {n.id: n for n in graph.rooms + graph.agents + graph.objects + graph.navigation}

    @classmethod
    def take_markers(cls, array):
        for marker in array.markers:
            if marker.action == Marker.DELETE:
                cls.shown.pop((marker.ns, marker.id), None)
            else:
                cls.shown[marker.ns, marker.id] = marker

    def reference(self, name="rooms.json"):
        """A result of `occusg run` on the same recording."""
        out = tempfile.mkdtemp(prefix="occusg_demo_test_")
        subprocess.run([rospy.get_param("~command"), "run", rospy.get_param("~sequence"), "-o", out],
                       check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(out, name)) as file:
            return json.load(file)

    def test_failure_mode_07_rooms_are_those_of_the_command_line_at_any_rate(self):
        self.assertEqual(self.mapping.count("images used"), FRAMES, "no image was lost")
        truth = self.reference()
        self.assertEqual(len(self.rooms.rooms), len(truth["rooms"]))
        partner = {}
        for room in self.rooms.rooms:
            overlaps = [(overlap(rings_of(room.polygon), [r["polygon"]] + r["holes"]), r["id"])
                        for r in truth["rooms"]]
            best, partner[room.id] = max(overlaps)
            self.assertGreaterEqual(best, 0.99, room.name)
        self.assertEqual(len(set(partner.values())), len(truth["rooms"]))
        self.assertEqual(
            {frozenset((partner[r.id], partner[n])) for r in self.rooms.rooms for n in r.adjacent},
            {frozenset(door["rooms"]) for door in truth["doors"]})

    def test_objects_are_those_of_the_command_line(self):
        def by_class(names):
            return {name: names.count(name) for name in names}

        wanted = by_class([node["class"] for node in self.reference("scene_graph.json")["nodes"]
                           if node["type"] == "OBJECT"])
        found = by_class([node.class_name for node in self.graph.objects])
        self.assertEqual(found, wanted)

    def test_every_path_is_drivable(self):
        """All cells under a path are free, the robot's radius around them too."""
        grid = rospy.wait_for_message("/occusg/free_space", OccupancyGrid, 20)
        cell_m, origin = grid.info.resolution, grid.info.origin.position
        cells = numpy.array(grid.data).reshape(grid.info.height, grid.info.width)
        closed = numpy.argwhere(cells != 0)[:, ::-1]
        closed = (closed + 0.5) * cell_m + (origin.x, origin.y)
        get_path = rospy.ServiceProxy("/occusg/get_path", GetPath)
        ids = [room.id for room in self.rooms.rooms]
        for start, goal in itertools.permutations(ids, 2):
            way = get_path(start, goal)
            self.assertTrue(way.success, way.message)
            self.assertEqual((way.rooms[0], way.rooms[-1]), (start, goal))
            points = numpy.array([(p.pose.position.x, p.pose.position.y) for p in way.path.poses])
            steps = numpy.diff(points, axis=0)
            yaws = [2 * numpy.arctan2(p.pose.orientation.z, p.pose.orientation.w)
                    for p in way.path.poses[:-1]]
            numpy.testing.assert_allclose(numpy.cos(yaws), steps[:, 0] / numpy.hypot(*steps.T),
                                          atol=1e-6)
            for point in points:
                near = numpy.hypot(*(closed - point).T).min()
                # From the middle of a cell on the path to the border of a closed one.
                self.assertGreater(near, ROBOT_RADIUS_M - 0.5 * cell_m, (start, goal, point))

    def test_zz_sessions_go_from_the_nodes_to_the_command_line_and_back(self):
        answer = rospy.ServiceProxy("/occusg/scene_graph/save", SaveMap)("demo_test")
        self.assertTrue(answer.success, answer.message)
        later = later_recording(rospy.get_param("~sequence"), LAST_STAMP_S + HOLD_S + 1.0)
        out = tempfile.mkdtemp(prefix="occusg_demo_test_")
        command = [rospy.get_param("~command"), "run", later, "-o", out,
                   "--resume", answer.folder + "/session"]
        alone = subprocess.run(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
                               universal_newlines=True)
        self.assertEqual(alone.returncode, 1)
        self.assertIn("was saved without a 3D map", alone.stderr)
        back = os.path.join(os.path.dirname(answer.folder), "of_command_line")
        shutil.rmtree(back, ignore_errors=True)
        subprocess.run(command + ["--map", answer.folder + "/map.ot", "--save-session",
                                  back + "/session"], check=True, stdout=subprocess.DEVNULL)
        with open(out + "/rooms.json") as file:
            gone_on = {room["id"]: room for room in json.load(file)["rooms"]}
        known = {room.number: room for room in self.rooms.rooms}
        self.assertEqual(set(gone_on), set(known))
        for number, room in gone_on.items():
            rings = [room["polygon"]] + room["holes"]
            self.assertGreater(overlap(rings_of(known[number].polygon), rings), 0.9, number)
        loaded = rospy.ServiceProxy("/occusg/scene_graph/load", LoadMap)("of_command_line")
        self.assertTrue(loaded.success, loaded.message)
        self.assertEqual({room.number for room in self.rooms.rooms}, set(known))

    def test_updates_add_up_to_the_graph(self):
        self.assertEqual(self.gaps, 0)
        self.assertEqual(self.nodes, self.nodes_of(self.graph))

    def test_markers_add_up_to_what_a_late_subscriber_sees(self):
        # Another process: a second subscriber of this one would share its connection.
        seen = subprocess.run([sys.executable, "-c", LATE_SUBSCRIBER], check=True, timeout=60,
                              stdout=subprocess.PIPE, universal_newlines=True).stdout
        self.assertEqual({tuple(key) for key in json.loads(seen)}, set(self.shown))
        self.assertEqual(sum(ns == "rooms" for ns, _ in self.shown), len(self.rooms.rooms))

    def test_what_can_change_live_changes_live(self):
        client = Client("/occusg/scene_graph", timeout=20)
        client.update_configuration({"room_height_m": 9.0})
        wait_until(lambda: all(m.pose.position.z == 9.0 for (ns, _), m in self.shown.items()
                               if ns == "rooms"), 10, "rooms float higher")

    def test_failure_mode_18_what_is_no_number_is_refused_live(self):
        for node, name in (("/mapping", "max_pose_jump_m"), ("/mapping", "tf_timeout_s"),
                           ("/scene_graph", "room_opacity")):
            client = Client("/occusg" + node, timeout=20)
            before = client.get_configuration()[name]
            for value in (float("nan"), float("inf"), -float("inf")):
                after = client.update_configuration({name: value})[name]
                self.assertTrue(numpy.isfinite(after), name)
                if numpy.isnan(value):
                    self.assertEqual(after, before, name)


if __name__ == "__main__":
    rostest.rosrun("occusg", "demo_test", DemoTest, sys.argv)

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
from nav_msgs.msg import OccupancyGrid
from occusg.srv import ListRooms, LoadMap, SaveMap, SetRoomLabel

from robot import Diagnostics, RosLog, Robot, camera_info, two_rooms, wait_until


class ShutdownTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("shutdown_test")
        cls.robot = Robot()
        cls.map_publisher = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        cls.folder = rospy.get_param("~folder", tempfile.mkdtemp(prefix="occusg_shutdown_test_"))

    def start(self, command, name, *arguments):
        process = subprocess.Popen([rospy.get_param("~" + command), "__name:=" + name,
                                    "_save_folder:=" + self.folder] + list(arguments))
        # One that a failed test leaves behind would keep the output of the test open.
        self.addCleanup(self.kill, process)
        return process

    def launch(self, folder, *arguments):
        """occusg.launch for laser maps, which saves into the folder."""
        process = subprocess.Popen(["roslaunch", "--skip-log-check", "occusg", "occusg.launch", "free_space:=/map",
                                    "mapping:=false", "save_folder:=" + folder] + list(arguments))
        self.addCleanup(self.end_launch, process)
        return process

    @classmethod
    def end_launch(cls, process):
        """A launch that a failed test leaves behind ends with its nodes."""
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(timeout=30)
            except subprocess.TimeoutExpired:
                cls.kill(process)

    @staticmethod
    def kill(process):
        if process.poll() is None:
            process.kill()
            process.wait(timeout=15)

    def end(self, process, number):
        started = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=15)
        self.assertLess(time.monotonic() - started, 5.0)

    def test_failure_mode_15_mapping_saves_on_sigint(self):
        process = self.start("mapping", "mapped", "depth/image_rect:=/camera/depth/image_rect",
                             "depth/camera_info:=/camera/depth/camera_info")
        diagnostics = Diagnostics("mapped: mapping")
        self.robot.wait_for_subscribers(self.robot.depth_publisher, self.robot.info_publisher,
                                        self.robot.tf_publisher)
        self.feed_images(diagnostics)
        self.end(process, signal.SIGINT)
        saved = os.path.join(self.folder, "last", "free_space.pgm")
        self.assertGreater(os.path.getsize(saved), 100)

    def test_failure_mode_15_scene_graph_saves_on_sigterm(self):
        process = self.start("scene_graph", "graphed", "free_space:=/map")
        self.feed_map(Diagnostics("graphed: scene graph"), 1.0, 2.0)
        self.end(process, signal.SIGTERM)
        with open(os.path.join(self.folder, "last", "rooms.json")) as rooms:
            self.assertGreaterEqual(rooms.read().count('"polygon"'), 1)

    def test_failure_mode_15_nodelets_of_a_launch_file_save_on_sigint(self):
        folder = tempfile.mkdtemp(prefix="occusg_launched_test_")
        process = self.launch(folder, "autosave_period_s:=0")
        self.feed_map(Diagnostics("occusg/scene_graph: scene graph"), 1.0, 2.0)
        self.end(process, signal.SIGINT)
        self.assertIn('"polygon"', self.saved(folder, "rooms.json"))
        self.assertIn("occusg-session", self.saved(folder, "session/session.json"))

    def feed_images(self, diagnostics):
        """Turns on the spot, with camera_info beside each image, until a few are in the map."""
        turn = iter(range(1000))

        def are_used():
            self.robot.info_publisher.publish(camera_info())
            self.robot.send_frame(rospy.Time.now(), yaw=0.05 * next(turn))
            return diagnostics.count("images used") >= 4
        wait_until(are_used, 30, "images are used")

    def feed_map(self, diagnostics, x, y):
        """Sends the laser map and the robot's place until the map is used."""
        self.map_publisher.publish(two_rooms(rospy.Time.now()))

        def is_used():
            self.robot.send_pose(rospy.Time.now(), x, y)
            time.sleep(0.1)
            return diagnostics.count("maps used") > 0
        wait_until(is_used, 30, "the map is used")

    @staticmethod
    def rooms():
        try:
            return rospy.ServiceProxy("list_rooms", ListRooms)(0.0).rooms
        except rospy.ServiceException:
            return []

    def test_failure_mode_19_killed_scene_graph_goes_on_with_the_same_room_ids(self):
        arguments = ("free_space:=/map", "_mapping_node:=")
        process = self.start("scene_graph", "first_life", *arguments)
        first = Diagnostics("first_life: scene graph")
        self.feed_map(first, 6.0, 2.0)

        def two_are_found():
            self.robot.send_pose(rospy.Time.now(), 6.0, 2.0)
            return len(self.rooms()) == 2
        wait_until(two_are_found, 30, "two rooms")
        before = self.rooms()
        self.assertGreater(before[0].position.x, 4.0, "the first room is where the robot is")
        rospy.ServiceProxy("set_room_label", SetRoomLabel)(before[1].id, "kitchen")
        before = self.rooms()
        answer = rospy.ServiceProxy("/first_life/save", SaveMap)("killed")
        self.assertTrue(answer.success, answer.message)
        process.kill()
        process.wait(timeout=15)

        process = self.start("scene_graph", "second_life", "_resume:=killed", *arguments)
        wait_until(lambda: len(self.rooms()) == 2, 30, "the rooms are there again")
        # In the other room: numbered anew, it would be the first.
        self.feed_map(Diagnostics("second_life: scene graph"), 1.0, 2.0)
        after = self.rooms()
        self.assertEqual([(r.id, r.label) for r in after], [(r.id, r.label) for r in before])
        for old, new in zip(before, after):
            self.assertAlmostEqual(old.position.x, new.position.x, delta=0.2)
        load = rospy.ServiceProxy("/second_life/load", LoadMap)
        self.assertFalse(load("no_such_session").success)
        self.assertEqual(len(self.rooms()), 2, "the live graph stays")
        self.assertTrue(load("killed").success)
        self.end(process, signal.SIGINT)

    def test_failure_mode_19_killed_mapping_goes_on_with_its_map(self):
        arguments = ("depth/image_rect:=/camera/depth/image_rect",
                     "depth/camera_info:=/camera/depth/camera_info", "free_space:=/mapped_space")
        process = self.start("mapping", "first_map", *arguments)
        self.robot.wait_for_subscribers(self.robot.depth_publisher, self.robot.info_publisher,
                                        self.robot.tf_publisher)
        diagnostics = Diagnostics("first_map: mapping")
        self.feed_images(diagnostics)
        # The last layer goes out a second after the last image; there is a report every second.
        diagnostics.wait_for_news(4)
        before = rospy.wait_for_message("/mapped_space", OccupancyGrid, 10)
        answer = rospy.ServiceProxy("/first_map/save", SaveMap)("killed_map")
        self.assertTrue(answer.success, answer.message)
        process.kill()
        process.wait(timeout=15)

        process = self.start("mapping", "second_map", "_resume:=killed_map", *arguments)
        after = rospy.wait_for_message("/mapped_space", OccupancyGrid, 20)
        self.assertEqual(after.info.width, before.info.width)
        self.assertEqual(after.data, before.data)
        rospy.wait_for_service("/second_map/load", 10)
        load = rospy.ServiceProxy("/second_map/load", LoadMap)
        self.assertFalse(load("../killed_map").success)
        self.assertTrue(load("killed_map").success)
        self.end(process, signal.SIGINT)


    def test_failure_mode_15_and_19_killed_nodes_go_on_from_the_autosave(self):
        folder = tempfile.mkdtemp(prefix="occusg_autosave_test_")
        own = ("_save_folder:=" + folder, "_autosave_period_s:=0.5")
        graph_arguments = own + ("free_space:=/map", "_mapping_node:=")
        map_arguments = own + ("depth/image_rect:=/camera/depth/image_rect",
                               "depth/camera_info:=/camera/depth/camera_info",
                               "free_space:=/autosaved_space")
        graph = self.start("scene_graph", "autosaved_graph", *graph_arguments)
        mapping = self.start("mapping", "autosaved_map", *map_arguments)
        self.feed_map(Diagnostics("autosaved_graph: scene graph"), 6.0, 2.0)
        self.robot.wait_for_subscribers(self.robot.depth_publisher, self.robot.info_publisher,
                                        self.robot.tf_publisher)

        def all_is_saved():
            self.robot.info_publisher.publish(camera_info())
            self.robot.send_frame(rospy.Time.now(), x=6.0, y=2.0)
            return all(os.path.exists(os.path.join(folder, "last", name))
                       for name in ("map.ot", "session/session.json", "rooms.json")) and \
                len(self.rooms()) == 2
        wait_until(all_is_saved, 40, "both are saved")
        before = [(room.id, room.name) for room in self.rooms()]
        rospy.ServiceProxy("set_room_label", SetRoomLabel)(before[0][0], "kitchen")
        wait_until(lambda: "kitchen" in self.saved(folder, "rooms.json"), 20,
                   "what changed is saved too")
        for process in (graph, mapping):
            process.kill()
            process.wait(timeout=15)

        resumed = self.start("scene_graph", "resumed_graph", "_resume:=last", *graph_arguments)
        wait_until(lambda: len(self.rooms()) == 2, 30, "the rooms are there again")
        self.assertEqual([(room.id, room.name) for room in self.rooms()], before)
        self.assertEqual(self.rooms()[0].label, "kitchen")
        mapping = self.start("mapping", "resumed_map", "_resume:=last", *map_arguments)
        layer = rospy.wait_for_message("/autosaved_space", OccupancyGrid, 20)
        self.assertGreater(layer.info.width, 10)
        self.end(resumed, signal.SIGINT)
        self.end(mapping, signal.SIGINT)
        self.neither_resumes_a_map_of_another_resolution(folder, map_arguments, own)

    def neither_resumes_a_map_of_another_resolution(self, folder, map_arguments, own):
        log = RosLog()
        other = ("_resume:=last", "_mapping/occupancy/resolution_m:=0.1")
        mapping = self.start("mapping", "coarse_map", *map_arguments, *other)
        graph = self.start("scene_graph", "coarse_graph", *own, *other, "free_space:=/map",
                           "_mapping_node:=/coarse_map")
        wait_until(lambda: log.said("coarse_map", "begins with an empty map"), 30, lambda: log.lines)
        wait_until(lambda: log.said("coarse_graph", "begins without rooms"), 30, lambda: log.lines)
        refused = [name for name in os.listdir(folder) if name.startswith("last.refused-")]
        self.assertGreaterEqual(len(refused), 1, os.listdir(folder))
        kept = os.path.join(folder, refused[0])
        self.assertIn("kitchen", open(os.path.join(kept, "rooms.json")).read())
        self.assertTrue(os.path.exists(os.path.join(kept, "map.ot")))
        self.end(graph, signal.SIGINT)
        self.end(mapping, signal.SIGINT)

    def test_failure_mode_17_and_19_what_cannot_be_resumed_is_kept_under_another_name(self):
        folder = tempfile.mkdtemp(prefix="occusg_refused_test_")
        arguments = ("_save_folder:=" + folder, "_autosave_period_s:=0.5", "free_space:=/map", "_mapping_node:=")
        process = self.start("scene_graph", "to_be_refused", *arguments)
        self.feed_map(Diagnostics("to_be_refused: scene graph"), 1.0, 2.0)
        session = os.path.join(folder, "last", "session", "session.json")
        wait_until(lambda: os.path.exists(session), 30, "the session is saved")
        self.end(process, signal.SIGINT)
        with open(session, "w") as file:
            file.write("damaged")

        process = self.start("scene_graph", "begins_anew", "_resume:=last", *arguments)
        self.feed_map(Diagnostics("begins_anew: scene graph"), 1.0, 2.0)
        wait_until(lambda: os.path.exists(session), 30, "another session is saved")
        self.end(process, signal.SIGINT)
        refused = [name for name in os.listdir(folder) if name.startswith("last.refused-")]
        self.assertEqual(len(refused), 1, os.listdir(folder))
        with open(os.path.join(folder, refused[0], "session", "session.json")) as file:
            self.assertEqual(file.read(), "damaged")

    def test_failure_mode_19_killed_manager_comes_back_and_goes_on(self):
        folder = tempfile.mkdtemp(prefix="occusg_manager_test_")
        launch = self.launch(folder, "autosave_period_s:=0.5")
        log = RosLog()
        diagnostics = Diagnostics("occusg/scene_graph: scene graph")
        self.feed_map(diagnostics, 1.0, 2.0)
        session = os.path.join(folder, "last", "session", "session.json")
        wait_until(lambda: os.path.exists(session), 30, "the session is saved")
        subprocess.check_call(["pkill", "-KILL", "-P", str(launch.pid), "-f", "nodelet manager"])
        wait_until(lambda: log.said("continues from the session", folder), 60, "the graph goes on")
        rooms = rospy.ServiceProxy("/occusg/list_rooms", ListRooms)
        rospy.wait_for_service("/occusg/list_rooms", 30)

        def two_are_found():
            self.robot.send_pose(rospy.Time.now(), 1.0, 2.0)
            return len(rooms(0.0).rooms) == 2
        wait_until(two_are_found, 30, "both rooms are there again")
        self.end(launch, signal.SIGINT)

    def test_failure_mode_19_manager_killed_again_and_again_while_it_starts_comes_back(self):
        folder = tempfile.mkdtemp(prefix="occusg_starting_manager_test_")
        launch = self.launch(folder)

        def managers():
            found = subprocess.run(["pgrep", "-P", str(launch.pid), "-f", "nodelet manager"], stdout=subprocess.PIPE)
            return found.stdout.split()
        for service in ("/occusg/manager/load_nodelet", "/occusg/list_rooms", "/occusg/manager/list"):
            rospy.wait_for_service(service, 30)
            killed = managers()
            os.kill(int(killed[0]), signal.SIGKILL)
            wait_until(lambda: managers() and managers() != killed, 30, "the manager is started again")
        rospy.wait_for_service("/occusg/list_rooms", 30)
        self.feed_map(Diagnostics("occusg/scene_graph: scene graph"), 1.0, 2.0)
        self.end(launch, signal.SIGINT)

    @staticmethod
    def saved(folder, name):
        with open(os.path.join(folder, "last", name)) as file:
            return file.read()

    def test_failure_mode_17_damaged_session_is_refused_and_the_live_graph_stays(self):
        process = self.start("scene_graph", "damaged", "free_space:=/map", "_mapping_node:=")
        self.feed_map(Diagnostics("damaged: scene graph"), 1.0, 2.0)

        def two_are_found():
            self.robot.send_pose(rospy.Time.now(), 1.0, 2.0)
            return len(self.rooms()) == 2
        wait_until(two_are_found, 30, "two rooms")
        answer = rospy.ServiceProxy("/damaged/save", SaveMap)("damaged")
        self.assertTrue(answer.success, answer.message)
        index = os.path.join(answer.folder, "session", "session.json")
        with open(index) as file:
            whole = file.read()
        load = rospy.ServiceProxy("/damaged/load", LoadMap)
        for damaged in (whole[:200], "", whole.replace('"version": 1', '"version": 99'), "x" * 100):
            self.assertNotEqual(damaged, whole)
            with open(index, "w") as file:
                file.write(damaged)
            refused = load("damaged")
            self.assertFalse(refused.success)
            self.assertIn("session.json", refused.message)
            self.assertEqual(len(self.rooms()), 2, "the live graph stays")
        with open(index, "w") as file:
            file.write(whole)
        self.assertTrue(load("damaged").success)
        self.end(process, signal.SIGINT)


if __name__ == "__main__":
    rostest.rosrun("occusg", "shutdown_test", ShutdownTest, sys.argv)

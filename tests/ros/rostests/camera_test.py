#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a live mapping node must survive: one test a row of the list, named after it."""
import math
import sys
import time
import unittest

import numpy
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid
from occusg.srv import SaveMap
from std_srvs.srv import SetBool, Trigger

from robot import (Diagnostics, HEIGHT, Robot, RosLog, WIDTH, camera_info, depth_image, wait_until)

BURST = 60 * 30


class CameraTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("camera_test")
        cls.robot = Robot(clock=True)
        cls.diagnostics = Diagnostics("/mapping: mapping")
        cls.log = RosLog()
        cls.layer = None
        cls.layers = 0
        rospy.Subscriber("/occusg/free_space", OccupancyGrid, cls.take_layer)
        cls.robot.wait_for_subscribers(cls.robot.clock_publisher, cls.robot.info_publisher,
                                       cls.robot.depth_publisher, cls.robot.tf_publisher,
                                       connections=2)
        cls.now = 1000.0
        cls.drive(8)

    @classmethod
    def take_layer(cls, layer):
        cls.layer = layer
        cls.layers += 1

    @classmethod
    def step(cls, seconds=0.2):
        cls.now += seconds
        return rospy.Time.from_sec(cls.now)

    @classmethod
    def drive(cls, frames, metres=3.0, x=0.0):
        """Turns on the spot until so many frames are in the map; a slow machine drops some."""
        wanted = max(cls.diagnostics.count("images used"), 0) + frames
        cls.robot.info_publisher.publish(camera_info())
        missing = frames
        while missing > 0:
            handled = cls.handled()
            # So long after the frame before that where that one looked does not count as a jump.
            cls.step(2.0)
            for i in range(missing):
                cls.robot.send_frame(cls.step(), x=x, yaw=0.08 * i, metres=metres)
                time.sleep(0.06)
            wait_until(lambda: cls.handled() >= handled + missing, 20,
                       lambda: "%d images are used: %s" % (frames, cls.diagnostics.values))
            missing = wanted - cls.diagnostics.count("images used")

    @classmethod
    def handled(cls):
        """Images that were used or gave way to newer ones."""
        return sum(max(cls.diagnostics.count(key), 0)
                   for key in ("images used", "dropped: overload"))

    def settled(self):
        """Cells of the layer once nothing comes any more."""
        # The last layer goes out a second after the last image; there is a report every second.
        self.diagnostics.wait_for_news(4)
        return self.layer.info, bytes(numpy.array(self.layer.data, dtype=numpy.int8))

    def refused(self, reason, send):
        """Sends what must leave no trace; waits until it was counted under `reason`."""
        key = "dropped: " + reason
        self.diagnostics.wait_for_news()
        used, before = self.diagnostics.count("images used"), self.diagnostics.count(key)
        sent = send()
        self.diagnostics.wait_for(key, before + sent)
        self.assertEqual(self.diagnostics.count("images used"), used)

    def test_failure_mode_01_pixels_that_are_no_depth_are_dropped_and_counted(self):
        pixels = numpy.full((HEIGHT, WIDTH), 3.0, dtype=numpy.float32)
        pixels[:12] = numpy.nan
        pixels[12:24] = numpy.inf
        pixels[24:30] = -1.0
        pixels[30:36] = 0.0
        nan = self.diagnostics.count("pixels: NaN")
        self.drive(1, pixels)
        self.diagnostics.wait_for("pixels: NaN", nan + 1)
        for kind in ("zero", "negative"):
            self.diagnostics.wait_for("pixels: " + kind, 1)

    def test_failure_mode_02_wrong_encoding_and_size_are_refused(self):
        def send():
            for change in ({"encoding": "rgb8"}, {"step": 3}, {"data": b"short"},
                           {"is_bigendian": 1}, {"width": 65535, "height": 65535}, {"height": 0}):
                image = depth_image(self.step(), 1.0)
                for field, value in change.items():
                    setattr(image, field, value)
                self.robot.send_pose(image.header.stamp)
                self.robot.depth_publisher.publish(image)
            return 6
        self.refused("bad_image", send)

    def announce(self, info):
        """Sends a camera_info, and waits until it counts."""
        received = self.diagnostics.count("camera_infos received")
        self.robot.info_publisher.publish(info)
        self.diagnostics.wait_for("camera_infos received", received + 1)

    def test_failure_mode_03_bad_intrinsics_stop_mapping_until_the_next_good_ones(self):
        def send():
            self.announce(camera_info(focal=0.0))
            self.robot.send_frame(self.step(), metres=1.0)
            return 1
        self.refused("no_camera_info", send)

        def send_of_another_size():
            self.announce(camera_info(width=100, height=100))
            self.robot.send_frame(self.step(), metres=1.0)
            return 1
        self.refused("refused_by_map", send_of_another_size)
        self.drive(1)

    def test_failure_mode_04_without_a_transform_an_image_is_dropped(self):
        def send():
            stamp = self.step(2.0)
            self.robot.set_clock(stamp)
            self.robot.depth_publisher.publish(depth_image(stamp, 1.0))
            return 1
        self.refused("no_transform", send)
        self.assertIn("map <- camera_optical_frame", self.diagnostics.values["last problem"])

    def test_failure_mode_04_transform_of_an_unknown_frame_is_never_made_up(self):
        def send():
            image = depth_image(self.step(), 1.0)
            image.header.frame_id = "nowhere"
            self.robot.depth_publisher.publish(image)
            return 1
        self.refused("no_transform", send)

    def test_failure_mode_05_pose_that_jumps_is_held_back(self):
        self.drive(2)

        def send():
            self.robot.send_frame(self.step(), x=50.0)
            return 1
        self.refused("pose_jump", send)
        self.drive(1)

    def test_failure_mode_06_equal_zero_and_future_stamps_are_ignored(self):
        def send():
            for stamp in (rospy.Time.from_sec(self.now), rospy.Time(),
                          rospy.Time.from_sec(self.now + 1e6)):
                self.robot.depth_publisher.publish(depth_image(stamp, 1.0))
            return 3
        self.refused("bad_stamp", send)

    def test_failure_mode_06_map_stays_when_the_clock_jumps_back(self):
        info, before = self.settled()
        type(self).now -= 60.0
        # As a bag does that begins again: the clock comes first, then the transforms.
        self.robot.set_clock(self.step())
        wait_until(lambda: self.diagnostics.stamp_s <= self.now, 20, "mapping's clock is back")
        self.robot.send_pose(self.step())
        # Before that, an image is older than all transforms there are.
        wait_until(lambda: self.log.said("/occusg/mapping: ", "transforms of the time before it are forgotten"), 20,
                   "mapping's transforms are of the new time")
        self.drive(3)
        after, _ = self.settled()
        self.assertGreaterEqual(after.width * after.height, info.width * info.height)
        self.assertGreater(numpy.count_nonzero(numpy.frombuffer(before, numpy.int8) == 0), 0)

    def test_failure_mode_07_diagnostics_go_on_while_the_clock_stands(self):
        reports = []
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, reports.append)
        wait_until(lambda: len(reports) >= 6, 20, "reports of two nodes every second")
        subscriber.unregister()
        self.assertLess(rospy.Time.now().to_sec(), self.now + 1.0, "the clock stands")

    def test_failure_mode_08_overload_drops_old_images_and_the_map_does_not_lag(self):
        self.diagnostics.wait_for_news()
        received = self.diagnostics.count("images received")
        for _ in range(150):
            self.robot.send_frame(self.step(0.03))
        # Not all 150: the queues of the publisher and the subscriber drop some before.
        self.diagnostics.wait_for("images received", received + 20, 30)
        self.settled()
        dropped = sum(self.diagnostics.count("dropped: " + why) for why in (
            "bad_image", "no_camera_info", "bad_stamp", "no_transform", "bad_transform",
            "pose_jump", "overload", "refused_by_map", "paused"))
        self.assertEqual(self.diagnostics.count("images used") + dropped,
                         self.diagnostics.count("images received"), "every image is accounted for")
        self.assertLess(float(self.diagnostics.values["lag of the map [s]"]), 1.0)

    def test_failure_mode_09_poses_beyond_the_reach_of_the_map_are_counted(self):
        def send():
            # So far apart in time that the jump alone is no reason.
            self.robot.send_frame(self.step(1.5), x=5000.0)
            return 1
        self.refused("refused_by_map", send)
        self.diagnostics.wait_for("frames misplaced", 1)
        self.step(2.0)
        self.drive(1)

    def test_failure_mode_10_full_map_takes_no_more_and_says_so(self):
        small = Diagnostics("/small: mapping")
        wait_until(lambda: small.count("dropped: refused_by_map") > 0 or not self.drive(4), 40,
                   "the small map is full")
        small.wait_for("dropped: refused_by_map", 1)
        self.assertIn("max_memory_mb", small.values["last problem"])

    def test_failure_mode_16_folder_that_cannot_be_written_is_said_and_survived(self):
        save = rospy.ServiceProxy("/occusg/small/save", SaveMap)
        answer = save("map")
        self.assertFalse(answer.success)
        self.assertIn("/proc/nowhere", answer.message)
        self.assertFalse(save("map").success, "the node lives")

    def test_failure_mode_18_save_takes_a_name_and_never_a_path(self):
        save = rospy.ServiceProxy("/occusg/mapping/save", SaveMap)
        for name in ("../x", "/etc/x", ".x", "a/b"):
            self.assertFalse(save(name).success, name)
        answer = save("camera_test")
        self.assertTrue(answer.success, answer.message)
        with open(answer.folder + "/free_space.yaml") as written:
            self.assertIn("resolution", written.read())

    def test_failure_mode_18_reset_can_be_forbidden(self):
        self.assertFalse(rospy.ServiceProxy("/occusg/small/reset", Trigger)().success)

    def spoiled(self, i):
        """The i-th of many images that cannot be used, one after another for another reason."""
        kind = i % 6
        if kind == 0:
            image = depth_image(rospy.Time.from_sec(self.now - 5.0), 1.0)  # of a time long gone
            image.encoding = "mono8"
            return image
        image = depth_image(self.step(1.0 / 30), 1.0)
        self.robot.set_clock(image.header.stamp)
        if kind == 1:
            image.encoding = "32FC4"
        elif kind == 2:
            image.data = image.data[:-7]
        elif kind == 3:
            image.width = image.height = 65535
        elif kind == 4:
            image.header.frame_id = "nowhere"
        else:
            image.header.stamp = rospy.Time.from_sec(self.now + 1e6)
        return image

    def test_burst_of_bad_input_leaves_no_trace_in_the_map(self):
        """As many as come in 60 s at 30 Hz; the map is that of a run without them."""
        _, before = self.settled()
        pause = rospy.ServiceProxy("/occusg/mapping/pause", SetBool)
        self.assertTrue(pause(True).success)
        self.robot.send_frame(self.step(), metres=1.0)
        # A service and a topic keep no order between them.
        self.diagnostics.wait_for("dropped: paused", 1)
        self.assertTrue(pause(False).success)
        received = self.diagnostics.count("images received")
        used = self.diagnostics.count("images used")
        for i in range(BURST):
            self.robot.depth_publisher.publish(self.spoiled(i))
            time.sleep(0.002)  # ten times as fast as a camera
        # Not quite all: the queues of the publisher and the subscriber may drop some.
        self.diagnostics.wait_for("images received", received + BURST // 2)
        _, after = self.settled()
        self.assertEqual(before, after)
        self.assertEqual(self.diagnostics.count("images used"), used)
        self.drive(1)

    def test_zz_reset_empties_the_map(self):
        self.assertTrue(rospy.ServiceProxy("/occusg/mapping/reset", Trigger)().success)
        wait_until(lambda: self.layer.info.width == 0, 5, "the layer is empty")
        self.drive(2)
        self.assertGreater(self.layer.info.width, 0)


if __name__ == "__main__":
    rostest.rosrun("occusg", "camera_test", CameraTest, sys.argv)

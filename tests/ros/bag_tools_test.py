#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A recording as a bag, and the bag through the pipeline; needs no master.

Usage: bag_tools_test.py OCCUSG OCCUSG_PLAY OCCUSG_BAG RECORDING WORK_FOLDER"""
import json
import os
import shutil
import struct
import subprocess
import sys
import unittest
import zlib

import numpy
import rosbag
from sensor_msgs.msg import CompressedImage

OCCUSG, PLAY, BAG, RECORDING, WORK = sys.argv[1:6]
FRAMES = 314
FIRST_STAMP_S = 1000.0  # where occusg_play begins


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True)


def read(folder, name):
    with open(os.path.join(WORK, folder, name), "rb") as file:
        return file.read()


def png_of(image):
    """A message of 16UC1 as a PNG (16 bits, grey, no filter)."""
    pixels = numpy.frombuffer(image.data, dtype=numpy.uint16).reshape(image.height, image.width)
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    header = struct.pack(">IIBBBBB", image.width, image.height, 16, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
            chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


class BagToolsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        cls.bag = os.path.join(WORK, "drive.bag")
        played = run(PLAY, RECORDING, "--bag", cls.bag, "--no-color")
        assert played.returncode == 0, played.stderr

    def refused(self, *command):
        """The one sentence a command that cannot work ends with."""
        ended = run(*command)
        self.assertEqual(ended.returncode, 1, ended.stdout)
        self.assertEqual(len(ended.stderr.splitlines()), 1, ended.stderr)
        return ended.stderr

    def test_bag_holds_the_recording(self):
        with rosbag.Bag(self.bag) as bag:
            topics = {name: (info.msg_type, info.message_count)
                      for name, info in bag.get_type_and_topic_info().topics.items()}
            first = next(bag.read_messages("/camera/depth/image_rect")).message
            info = next(bag.read_messages("/camera/depth/camera_info")).message
        self.assertEqual(topics, {
            "/tf": ("tf2_msgs/TFMessage", FRAMES),
            "/occusg/detections": ("occusg/DetectionArray", FRAMES),
            "/odom": ("nav_msgs/Odometry", FRAMES),
            "/camera/depth/camera_info": ("sensor_msgs/CameraInfo", FRAMES),
            "/camera/depth/image_rect": ("sensor_msgs/Image", FRAMES)})
        self.assertEqual(first.encoding, "16UC1")
        self.assertEqual((first.width, first.height), (info.width, info.height))
        self.assertAlmostEqual(first.header.stamp.to_sec(), FIRST_STAMP_S)
        self.assertEqual(first.header.frame_id, info.header.frame_id)

    def test_bag_gives_the_files_and_rooms_of_the_recording(self):
        out = os.path.join(WORK, "of_bag")
        ended = run(BAG, self.bag, "-o", out)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("%d of %d images used" % (FRAMES, FRAMES), ended.stdout)
        reference = os.path.join(WORK, "of_recording")
        self.assertEqual(run(OCCUSG, "run", RECORDING, "-o", reference).returncode, 0)
        self.assertEqual(sorted(os.listdir(out)), sorted(os.listdir(reference)))
        for name in ("map.ot", "free_space.pgm"):
            self.assertEqual(read("of_bag", name), read("of_recording", name), name)
        of_bag, of_recording = (json.loads(read(folder, "rooms.json"))
                                for folder in ("of_bag", "of_recording"))
        self.assertGreater(len(of_bag["rooms"]), 1)
        for key in ("id", "polygon", "holes"):
            self.assertEqual([room[key] for room in of_bag["rooms"]],
                             [room[key] for room in of_recording["rooms"]])
        self.assertEqual(of_bag["doors"], of_recording["doors"])

    def changed_bag(self, name, change):
        """The bag with its messages changed; the path."""
        path = os.path.join(WORK, name)
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(path, "w") as changed:
            for topic, message, stamp in bag.read_messages():
                change(topic, message)
                changed.write(topic, message, stamp)
        return path

    def assert_gives_the_same_rooms(self, out, *command):
        ended = run(BAG, *command, "-o", os.path.join(WORK, out))
        self.assertEqual(ended.returncode, 0, ended.stderr)
        if not os.path.exists(os.path.join(WORK, "of_bag")):
            self.assertEqual(run(BAG, self.bag, "-o", os.path.join(WORK, "of_bag")).returncode, 0)
        rooms = json.loads(read(out, "rooms.json"))["rooms"]
        self.assertEqual(rooms, json.loads(read("of_bag", "rooms.json"))["rooms"])

    def test_names_of_frames_with_a_slash_are_those_without(self):
        def with_slashes(topic, message):
            if topic in ("/tf", "/tf_static"):
                for transform in message.transforms:
                    transform.header.frame_id = "/" + transform.header.frame_id
                    transform.child_frame_id = "/" + transform.child_frame_id
            elif hasattr(message, "header"):
                message.header.frame_id = "/" + message.header.frame_id
        self.assert_gives_the_same_rooms("of_slashes", self.changed_bag("slashes.bag", with_slashes))

    def test_depth_in_quarter_millimetres_needs_its_scale(self):
        def in_quarters(topic, message):
            if topic == "/camera/depth/image_rect":
                self.assertEqual(message.encoding, "16UC1")
                depth = numpy.frombuffer(message.data, dtype=numpy.uint16)
                message.data = numpy.where(depth == 65535, 65535, depth * 4).astype(numpy.uint16).tobytes()
        path = self.changed_bag("quarters.bag", in_quarters)
        self.assert_gives_the_same_rooms("of_quarters", path, "--depth-scale", "4000")
        unscaled = run(BAG, path, "-o", os.path.join(WORK, "unscaled"))
        self.assertRegex(unscaled.stderr, r"the lowest floor that was seen is at z = -\d+\.\d m.*--depth-scale")
        self.assertRegex(unscaled.stderr, r"room_\d+ has \d+ m2, more than any room of a flat")
        self.assertNotIn("floor", run(BAG, path, "-o", os.path.join(WORK, "scaled"), "--depth-scale", "4000").stderr)
        self.assertIn("--depth-scale", self.refused(BAG, path, "-o", os.path.join(WORK, "never"), "--depth-scale", "0"))

    def test_several_bags_are_one_recording(self):
        paths = [os.path.join(WORK, name) for name in ("second.bag", "first.bag")]
        with rosbag.Bag(self.bag) as bag:
            middle = (bag.get_start_time() + bag.get_end_time()) / 2
            with rosbag.Bag(paths[1], "w") as first, rosbag.Bag(paths[0], "w") as second:
                for topic, message, stamp in bag.read_messages():
                    (first if stamp.to_sec() < middle else second).write(topic, message, stamp)
        self.assert_gives_the_same_rooms("of_parts", *paths)

    def test_compressed_depth_is_the_same_depth(self):
        path = os.path.join(WORK, "compressed.bag")
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(path, "w") as packed:
            for topic, message, stamp in bag.read_messages():
                if topic == "/camera/depth/image_rect":
                    topic += "/compressedDepth"
                    message = CompressedImage(header=message.header,
                                              format="16UC1; compressedDepth png",
                                              data=bytes(12) + png_of(message))
                packed.write(topic, message, stamp)
        self.assert_gives_the_same_rooms("of_compressed", path)

    def test_a_model_finds_the_objects_of_the_recording(self):
        models = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "segmentation")
        model = ("--model", os.path.join(models, "middle.onnx"), "--classes", os.path.join(models, "classes.txt"))
        path = os.path.join(WORK, "colour.bag")
        self.assertEqual(run(PLAY, RECORDING, "--bag", path).returncode, 0)
        ended = run(BAG, path, "-o", os.path.join(WORK, "objects_of_bag"), *model)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertEqual(run(OCCUSG, "run", RECORDING, "-o", os.path.join(WORK, "objects_of_recording"), *model).returncode, 0)
        of_bag, of_recording = ([[round(x, 2) for x in node["position"]]
                                 for node in json.loads(read(folder, "scene_graph.json"))["nodes"] if node["type"] == "OBJECT"]
                                for folder in ("objects_of_bag", "objects_of_recording"))
        self.assertGreater(len(of_bag), 0)
        self.assertEqual(of_bag, of_recording)
        self.assertIn("stands alone", self.refused(BAG, path, "-o", os.path.join(WORK, "never"), *model[:2]))
        self.assertIn("--color", self.refused(BAG, self.bag, "-o", os.path.join(WORK, "never"), *model))

    def test_a_bag_that_was_not_closed_is_told_how_to_mend(self):
        path = os.path.join(WORK, "unindexed.bag")
        with open(self.bag, "rb") as file:
            data = bytearray(file.read())
        place = data.index(b"index_pos=") + len(b"index_pos=")
        data[place:place + 8] = bytes(8)
        with open(path, "wb") as file:
            file.write(data)
        self.assertIn("rosbag reindex", self.refused(BAG, path, "-o", os.path.join(WORK, "never")))

    def test_images_without_a_pose_are_counted_and_fail_the_run(self):
        ended = run(BAG, self.bag, "-o", os.path.join(WORK, "lost"), "--map-frame", "nowhere")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("no_transform: %d" % FRAMES, ended.stderr)

    def test_what_cannot_be_used_is_said_in_one_sentence(self):
        out = os.path.join(WORK, "none")
        self.assertIn("name a bag", self.refused(BAG))
        self.assertIn("nowhere.bag", self.refused(BAG, os.path.join(WORK, "nowhere.bag"), "-o", out))
        text = os.path.join(WORK, "text.bag")
        with open(text, "w") as file:
            file.write("no bag\n")
        self.refused(BAG, text, "-o", out)
        self.assertIn("--depth", self.refused(BAG, self.bag_of_two_cameras(), "-o", out))
        self.assertIn("nowhere", self.refused(PLAY, os.path.join(WORK, "nowhere"), "--bag", text))
        self.assertTrue(self.refused(PLAY, RECORDING, "--rate", "0").startswith("occusg_play: --rate"))
        self.assertTrue(self.refused(PLAY).startswith("occusg_play: name one sequence"))

    def test_a_topic_that_is_not_in_the_bag_is_refused_with_those_that_are(self):
        out = os.path.join(WORK, "no_topic")
        sentence = self.refused(BAG, self.bag, "-o", out, "--depth", "/depth")
        self.assertIn("drive.bag: has no images on /depth; it has images on /camera/depth/image_rect (--depth", sentence)
        sentence = self.refused(BAG, self.bag, "-o", out, "--info", "/camera_info")
        self.assertIn("has no camera_info on /camera_info; it has camera_info on /camera/depth/camera_info (--info", sentence)
        sentence = self.refused(BAG, self.bag_of_two_cameras(), "-o", out, "--depth", "/left/depth")
        self.assertIn("has no camera_info on /left/camera_info; it has none on any topic", sentence)
        self.assertFalse(os.path.exists(out))

    def test_results_do_not_go_into_a_session(self):
        session = os.path.join(WORK, "session")
        os.makedirs(session)
        with open(os.path.join(session, "session.json"), "w") as file:
            file.write('{\n"format": "occusg-session"}\n')
        self.assertIn("holds a saved session", self.refused(BAG, self.bag, "-o", session))
        self.assertEqual(os.listdir(session), ["session.json"])

    def bag_of_two_cameras(self):
        path = os.path.join(WORK, "two.bag")
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(path, "w") as two:
            _, image, stamp = next(bag.read_messages("/camera/depth/image_rect"))
            two.write("/left/depth", image, stamp)
            two.write("/right/depth", image, stamp)
        return path


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

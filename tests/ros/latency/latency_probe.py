#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How long it takes from a depth image to the scene graph that shows it, and how long callbacks take.

Listens to both and prints one line of JSON when the recording has ended."""
import json
import struct
import threading
import time

import numpy
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from occusg.msg import RegionArray


class Probe:
    def __init__(self):
        self.sent = {}
        self.latencies_ms = []
        self.rest_ms = []
        self.last = time.monotonic()
        self.callbacks = {}
        self.lock = threading.Lock()
        rospy.Subscriber("/camera/depth/image_rect", rospy.AnyMsg, self.take_image, queue_size=100)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.take_diagnostics, queue_size=100)
        rospy.Subscriber("/occusg/regions", RegionArray, self.take_regions, queue_size=100)

    def take_image(self, message):
        now = time.monotonic()
        # The header alone: reading whole images in Python would be what is measured.
        _, seconds, nanoseconds = struct.unpack("<III", message._buff[:12])
        with self.lock:
            self.sent[seconds, nanoseconds] = self.last = now

    def take_regions(self, regions):
        now = time.monotonic()
        stamp = regions.header.stamp
        with self.lock:
            sent = self.sent.get((stamp.secs, stamp.nsecs))
            # Maintenance publishes too, at times no image has.
            if sent is None:
                return
            # Once images stop, what is left of them is published a second later, on purpose.
            is_rest = now - self.last > 0.5
            (self.rest_ms if is_rest else self.latencies_ms).append(1000 * (now - sent))

    def take_diagnostics(self, array):
        for status in array.status:
            values = {entry.key: entry.value for entry in status.values}
            if "longest callback [ms]" in values:
                with self.lock:
                    self.callbacks[status.name.split(":")[0].lstrip("/")] = "%s: %.1f ms" % (
                        values["longest callback"], float(values["longest callback [ms]"]))

    def run(self):
        while not rospy.is_shutdown():
            time.sleep(0.5)
            with self.lock:
                if self.latencies_ms and time.monotonic() - self.last > 3:
                    break
        values = numpy.array(self.latencies_ms)
        print(json.dumps({"images": len(self.sent), "updates": len(values),
                          "median_ms": round(float(numpy.median(values)), 1),
                          "p95_ms": round(float(numpy.percentile(values, 95)), 1),
                          "max_ms": round(float(values.max()), 1),
                          "longest_callbacks": self.callbacks,
                          "after_the_last_image_ms": [round(v, 1) for v in self.rest_ms]}),
              flush=True)


if __name__ == "__main__":
    rospy.init_node("latency_probe")
    Probe().run()

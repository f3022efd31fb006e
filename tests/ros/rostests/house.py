# SPDX-License-Identifier: BSD-3-Clause
"""A house of two storeys made of boxes, and what a depth camera sees that is carried through it."""
import math

import numpy

from robot import FOCAL, HEIGHT, WIDTH

UPPER_FLOOR_M = 3.0
CAMERA_ABOVE_FLOOR_M = 1.2
STEP_M = 0.2
TURN_RAD = 0.4


def walls(floor_m):
    """Two rooms of 4 x 4 m, joined by a door 0.9 m wide at x = 4."""
    top = floor_m + 2.5
    return [((-0.2, -0.2, floor_m), (8.4, 0.0, top)), ((-0.2, 4.0, floor_m), (8.4, 4.2, top)),
            ((-0.2, 0.0, floor_m), (0.0, 4.0, top)), ((8.2, 0.0, floor_m), (8.4, 4.0, top)),
            ((4.0, 0.0, floor_m), (4.2, 1.55, top)), ((4.0, 2.45, floor_m), (4.2, 4.0, top)),
            ((4.0, 1.55, floor_m + 2.0), (4.2, 2.45, top))]


def boxes():
    """Corners (low, high) of all boxes; in the east room a stair leads up along the north wall."""
    slab = [((-0.2, -0.2, 2.5), (8.4, 2.9, 3.0)), ((-0.2, 2.9, 2.5), (4.4, 4.2, 3.0)),
            ((7.2, 2.9, 2.5), (8.4, 4.2, 3.0)), ((4.4, 4.0, 2.5), (7.2, 4.2, 3.0))]
    treads = [((4.4 + 0.2 * i, 2.9, 0.0), (4.6 + 0.2 * i, 4.0, 0.2 * (i + 1))) for i in range(14)]
    ground = [((-0.2, -0.2, -0.2), (8.4, 4.2, 0.0))]
    roof = [((-0.2, -0.2, 5.5), (8.4, 4.2, 5.7))]
    return numpy.array(ground + walls(0.0) + slab + treads + walls(UPPER_FLOOR_M) + roof)


BOXES = boxes()


def depth_from(position, yaw):
    """Depths [m] of the pixels of a level camera; `HEIGHT` rows."""
    v, u = numpy.mgrid[:HEIGHT, :WIDTH]
    right, down = (u + 0.5 - WIDTH / 2) / FOCAL, (v + 0.5 - HEIGHT / 2) / FOCAL
    forward = numpy.array([math.cos(yaw), math.sin(yaw), 0.0])
    side = numpy.array([math.sin(yaw), -math.cos(yaw), 0.0])
    rays = (forward + right[..., None] * side - down[..., None] * numpy.array([0.0, 0.0, 1.0]))
    rays[rays == 0.0] = 1e-12
    nearest = numpy.full((HEIGHT, WIDTH), numpy.inf)
    for low, high in BOXES:
        a, b = (low - position) / rays, (high - position) / rays
        enters = numpy.minimum(a, b).max(axis=-1)
        leaves = numpy.maximum(a, b).min(axis=-1)
        hits = (enters > 0.0) & (enters <= leaves)
        nearest[hits] = numpy.minimum(nearest[hits], enters[hits])
    # The rays advance one metre of depth at a time.
    return numpy.where(numpy.isfinite(nearest), nearest, 0.0).astype(numpy.float32)


class Tour:
    """Poses (x, y, z of the feet, yaw) of somebody who walks through the house without haste."""

    def __init__(self, x, y, z):
        self.feet = numpy.array([x, y, z])
        self.yaw = 0.0
        self.poses = []

    def look_round(self):
        start = self.yaw
        for i in range(1, 17):
            self.yaw = start + 2.0 * math.pi * i / 16
            self.poses.append((*self.feet, self.yaw))
        return self

    def turn_to(self, yaw):
        start = self.yaw
        angle = math.remainder(yaw - start, 2.0 * math.pi)
        steps = math.ceil(abs(angle) / TURN_RAD)
        for i in range(1, steps + 1):
            self.yaw = start + angle * i / steps
            self.poses.append((*self.feet, self.yaw))

    def to(self, x, y, z):
        start, end = self.feet, numpy.array([x, y, z])
        # Not along the axes of the boxes, whose sides would be seen edge on.
        self.turn_to(math.atan2(y - start[1], x - start[0]) + 0.01)
        steps = math.ceil(numpy.linalg.norm(end - start) / STEP_M)
        for i in range(1, steps + 1):
            self.feet = start + (end - start) * i / steps
            self.poses.append((*self.feet, self.yaw))
        return self


def tour_of_both_storeys():
    """Through the rooms of the ground floor, up the stair, through the rooms of the upper floor."""
    up = UPPER_FLOOR_M
    tour = Tour(1.7, 2.0, 0.0).to(1.9, 2.0, 0.0).look_round().to(6.2, 2.0, 0.0).look_round()
    tour.to(4.35, 2.4, 0.0).to(4.35, 3.4, 0.0).to(7.3, 3.4, up)
    tour.to(7.6, 1.8, up).to(6.2, 1.8, up).look_round()
    return tour.to(4.1, 2.0, up).to(1.9, 2.0, up).look_round().poses

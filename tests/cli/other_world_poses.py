#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the poses of a recording as another system would have them.

Usage: other_world_poses.py KIND GROUNDTRUTH > POSES
KIND: first-camera (the world is the first camera, as ORB-SLAM has it), body (x forward, z up),
      upside-down (the camera turned half about its axis), w-first (quaternions qw qx qy qz),
      low (everything 3 m lower), sparse (every second pose)
"""
import sys


def product(a, b):
    """Of quaternions x, y, z, w."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz)


def conjugate(q):
    return (-q[0], -q[1], -q[2], q[3])


def turned(q, v):
    return product(product(q, (*v, 0.0)), conjugate(q))[:3]


def main():
    kind, path = sys.argv[1:]
    poses = []
    with open(path, encoding='utf-8') as file:
        for line in file:
            if line.strip() and not line.startswith('#'):
                stamp, *values = line.split()
                values = [float(value) for value in values]
                poses.append((stamp, values[:3], tuple(values[3:])))
    first_position, first = poses[0][1:]
    optical_in_body = (-0.5, 0.5, -0.5, 0.5)
    for number, (stamp, position, rotation) in enumerate(poses):
        if kind == 'first-camera':
            position = turned(conjugate(first), [a - b for a, b in zip(position, first_position)])
            rotation = product(conjugate(first), rotation)
        elif kind == 'body':
            rotation = product(rotation, conjugate(optical_in_body))
        elif kind == 'upside-down':
            rotation = product(rotation, (0.0, 0.0, 1.0, 0.0))
        elif kind == 'low':
            position = [*position[:2], position[2] - 3.0]
        elif kind == 'sparse' and number % 2:
            continue
        if kind == 'w-first':
            rotation = (rotation[3], *rotation[:3])
        print(stamp, *(f'{value:.9f}' for value in [*position, *rotation]))


main()

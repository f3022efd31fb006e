#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the small segmentation models that the tests of OnnxSegmenter read.

Usage: make_segmentation_models.py [FOLDER]   (default: segmentation/ beside this script)
Needs numpy and onnx from PyPI; the files in the repository came from onnx 1.23.

Each model gives the same predictions for every image: the image is averaged, multiplied by zero
weights, and the predictions are the bias. The prototypes do depend on the image: they are averages
over 4 x 4 pixels of the input, 8 R - 4 (above zero where it is red), 8 B - 4, a constant 1, and 29
channels of zeros. So each mask is the red part, the blue part, or all of its box.
"""
import os
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

SIDE = 64  # of the square input [pixels]
COEFFICIENTS = 32
RED, BLUE, ALL = 0, 1, 2  # prototypes
CLASSES = ["chair", "table", "lamp"]

# Class, score, prototype, box corners in pixels of the input.
ANCHORS = [
    (0, 0.90, RED, (8, 16, 32, 48)),
    (0, 0.80, RED, (9, 16, 33, 48)),  # overlaps the first (IoU 0.92): suppressed
    (1, 0.75, ALL, (8, 16, 32, 48)),  # the same box, another class: stays
    (2, 0.95, BLUE, (40, 24, 56, 40)),
    (0, 0.69, ALL, (0, 0, 8, 8)),  # not confident enough
    (0, 0.72, ALL, (18, 16, 42, 48)),  # overlaps the first (IoU 0.41): stays
]
END_TO_END = [
    (2, 0.95, BLUE, (40, 24, 56, 40)),
    (0, 0.90, RED, (8, 16, 32, 48)),
    (7, 0.85, ALL, (8, 16, 32, 48)),  # no such class
    (0, 0.80, ALL, (9, 16, 33, 48)),  # overlaps the first: stays, the model has suppressed already
    (0, 0.50, ALL, (0, 0, 8, 8)),  # not confident enough
]
# The middle quarter of a 4:3 picture, whatever it shows: 64 x 48 of the input are the picture.
MIDDLE = [(1, 0.875, ALL, (16, 20, 48, 44))]


def coefficients(prototype):
    values = np.zeros(COEFFICIENTS)
    values[prototype] = 1.0
    return values


def anchor_predictions():
    """(4 + classes + coefficients) x anchors: box centre and size, scores, coefficients."""
    columns = []
    for class_id, score, prototype, (x0, y0, x1, y1) in ANCHORS:
        scores = np.zeros(len(CLASSES))
        scores[class_id] = score
        box = [(x0 + x1) / 2, (y0 + y1) / 2, x1 - x0, y1 - y0]
        columns.append(np.concatenate([box, scores, coefficients(prototype)]))
    return np.stack(columns, axis=1)


def end_to_end_predictions(instances):
    """rows x (6 + coefficients): box corners, score, class, coefficients."""
    return np.stack([
        np.concatenate([box, [score, class_id], coefficients(prototype)])
        for class_id, score, prototype, box in instances
    ])


def weights(name, values, kind=np.float32):
    return numpy_helper.from_array(np.asarray(values, kind), name)


def prediction_nodes(values, padded_shape):
    """Nodes that give `values`, with zeros up to `padded_shape`."""
    missing = [padded - given for padded, given in zip(padded_shape, values.shape)]
    nodes = [
        helper.make_node("GlobalAveragePool", ["images"], ["mean"], name="mean"),
        # Not Gemm: OpenCV 4.10 cannot import one whose input has no fixed size.
        helper.make_node("Conv", ["mean", "zero", "values"], ["flat"], name="flat",
                         kernel_shape=[1, 1]),
        helper.make_node("Reshape", ["flat", "shape"], ["given"], name="given"),
        helper.make_node("Pad", ["given"], ["output0"], name="padded", pads=[0, 0, 0, 0] + missing),
    ]
    constants = [
        weights("zero", np.zeros((values.size, 3, 1, 1))),
        weights("values", values.reshape(-1)),
        weights("shape", (1, ) + values.shape, np.int64),
    ]
    return nodes, constants


def prototype_nodes():
    mix = np.zeros((COEFFICIENTS, 3, 1, 1))
    mix[RED, 0] = 8.0
    mix[BLUE, 2] = 8.0
    bias = np.zeros(COEFFICIENTS)
    bias[[RED, BLUE]] = -4.0
    bias[ALL] = 1.0
    nodes = [
        helper.make_node("AveragePool", ["images"], ["coarse"], name="coarse",
                         kernel_shape=[4, 4], strides=[4, 4]),
        helper.make_node("Conv", ["coarse", "mix", "bias"], ["output1"], name="prototypes",
                         kernel_shape=[1, 1]),
    ]
    return nodes, [weights("mix", mix), weights("bias", bias)]


def tensor(name, shape):
    return helper.make_tensor_value_info(name, TensorProto.FLOAT, shape)


def save(path, nodes, constants, inputs, outputs, check=True):
    graph = helper.make_graph(nodes, os.path.basename(path), inputs, outputs, constants)
    # Opset 10: OpenCV 4.2 does not know the Pad of later ones.
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 10)], ir_version=5,
                              producer_name="make_segmentation_models.py")
    if check:
        onnx.checker.check_model(model, full_check=True)
    with open(path, "wb") as file:
        file.write(model.SerializeToString(deterministic=True))


def save_segmenter(path, values, padded_shape, size=(SIDE, SIDE), prototypes_first=False):
    prediction, prediction_constants = prediction_nodes(values, padded_shape)
    prototype, prototype_constants = prototype_nodes()
    outputs = [
        tensor("output0", (1, ) + padded_shape),
        tensor("output1", (1, COEFFICIENTS) + (("h", "w") if "height" in size else (16, 16))),
    ]
    if prototypes_first:
        outputs.reverse()
    save(path, prediction + prototype, prediction_constants + prototype_constants,
         [tensor("images", (1, 3) + size)], outputs)


def save_unusable(folder):
    """Models that must be refused."""
    path = lambda name: os.path.join(folder, name)
    image = tensor("images", (1, 3, SIDE, SIDE))
    nodes, constants = prototype_nodes()
    save(path("one_output.onnx"), nodes, constants, [image],
         [tensor("output1", (1, COEFFICIENTS, 16, 16))])
    save(path("unknown_layer.onnx"),
         nodes + [helper.make_node("NoSuchOperator", ["output1"], ["output0"], name="/model/odd")],
         constants, [image],
         [tensor("output0", (1, 3, 3)), tensor("output1", (1, COEFFICIENTS, 16, 16))], check=False)
    save(path("grey_input.onnx"), [
        helper.make_node("Relu", ["images"], ["output0"]),
        helper.make_node("Sigmoid", ["images"], ["output1"])
    ], [], [tensor("images", (1, 1, SIDE, SIDE))],
         [tensor("output0", (1, 1, SIDE, SIDE)), tensor("output1", (1, 1, SIDE, SIDE))])
    save(path("two_images.onnx"), [
        helper.make_node("Relu", ["images"], ["output0"]),
        helper.make_node("Sigmoid", ["depth"], ["output1"])
    ], [], [image, tensor("depth", (1, 3, SIDE, SIDE))],
         [tensor("output0", (1, 3, SIDE, SIDE)), tensor("output1", (1, 3, SIDE, SIDE))])
    save_segmenter(path("odd_shape.onnx"), np.ones((7, 9)), (7, 9))


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "segmentation")
    os.makedirs(folder, exist_ok=True)
    path = lambda name: os.path.join(folder, name)
    anchors = anchor_predictions()
    # 8 x 8 + 4 x 4 + 2 x 2 anchors: what a YOLOv8 has at this size.
    save_segmenter(path("anchors.onnx"), anchors, (anchors.shape[0], 84))
    save_segmenter(path("prototypes_first.onnx"), anchors, (anchors.shape[0], 84),
                   prototypes_first=True)
    rows = end_to_end_predictions(END_TO_END)
    save_segmenter(path("end_to_end.onnx"), rows, (300, rows.shape[1]))
    save_segmenter(path("any_size.onnx"), rows, (300, rows.shape[1]), size=("height", "width"))
    save_segmenter(path("middle.onnx"), end_to_end_predictions(MIDDLE), (300, rows.shape[1]))
    save_unusable(folder)
    with open(path("classes.txt"), "w", encoding="utf-8") as file:
        file.write("\n".join(CLASSES) + "\n")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens a scene_graph.dsg.json with spark_dsg and compares it with the scene_graph.json beside it.

Usage: check_spark_dsg.py FOLDER
"""
import json
import os
import sys

import spark_dsg

SYMBOLS = {"AGENT": "a", "OBJECT": "O", "NAVIGATION": "p", "ROOM": "R"}
FIRST_IDS = {"AGENT": 0, "OBJECT": 1_000_000, "NAVIGATION": 2_000_000, "ROOM": 4_000_000}


def symbol(node_type, node_id):
    return spark_dsg.NodeSymbol(SYMBOLS[node_type], node_id - FIRST_IDS[node_type]).value


def layers(graph):
    names = spark_dsg.DsgLayers
    return {
        "AGENT": graph.get_layer(names.AGENTS),
        "OBJECT": graph.get_layer(names.OBJECTS),
        "NAVIGATION": graph.get_layer(names.PLACES),
        "ROOM": graph.get_layer(names.ROOMS),
    }


def parents(document, types):
    """What each node hangs from: its room; of an object in no room, its navigation node."""
    found = {}
    for wanted in ("NEAREST_FREE_SPACE", "ROOM_CONTAINS"):
        for edge in document["edges"]:
            if edge["type"] != wanted:
                continue
            source, target = edge["source"], edge["target"]
            child, parent = (source, target) if wanted == "NEAREST_FREE_SPACE" else (target, source)
            found[child] = symbol(types[parent], parent)
    return found


def main(folder):
    graph = spark_dsg.DynamicSceneGraph.load(os.path.join(folder, "scene_graph.dsg.json"))
    with open(os.path.join(folder, "scene_graph.json")) as file:
        document = json.load(file)
    nodes = [node for node in document["nodes"] if node["type"] in SYMBOLS]
    types = {node["id"]: node["type"] for node in nodes}
    found = layers(graph)
    for name, layer in found.items():
        assert layer.num_nodes() == sum(node["type"] == name for node in nodes), name
    for name, layer in found.items():
        assert layer.num_nodes() > 0, f"no {name} to compare"
    expected_parents = parents(document, types)
    for node in nodes:
        opened = graph.get_node(symbol(node["type"], node["id"]))
        assert max(abs(opened.attributes.position - node["position"])) < 1e-6, node["id"]
        assert opened.get_parent() == expected_parents.get(node["id"]), node["id"]
        if node["type"] == "ROOM":
            assert opened.attributes.name == node["name"]
        if node["type"] == "OBJECT":
            assert opened.attributes.name == node["class"]
            box = opened.attributes.bounding_box
            for corner, expected in zip((box.min, box.max), node["box"]):
                assert max(abs(corner - expected)) < 2e-4, node["id"]
    counts = {name: layer.num_nodes() for name, layer in found.items()}
    print(f"spark_dsg opens {counts}, {len(expected_parents)} of them with a parent")


if __name__ == "__main__":
    main(*sys.argv[1:])

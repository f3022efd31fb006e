#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a scene_graph.graphml with networkx and compares it with the scene_graph.json beside it.

Usage: check_graphml.py FOLDER
"""
import json
import os
import sys

import networkx

ALL = ["floor_id", "created_s", "last_seen_s"]
CARRIED = {
    "AGENT": ALL,
    "OBJECT": [*ALL, "score", "observations"],
    "NAVIGATION": [*ALL, "free_cells"],
    "ROOM": [*ALL, "name", "label", "label_score", "label_source", "state", "frontier_share", "area_m2", "region_id"],
    "DOOR": [*ALL, "width_m"],
}


def main(folder):
    graph = networkx.read_graphml(os.path.join(folder, "scene_graph.graphml"))
    with open(os.path.join(folder, "scene_graph.json")) as file:
        document = json.load(file)
    assert graph.is_directed()
    assert graph.graph["scene"] == document["scene"]
    assert graph.number_of_nodes() == len(document["nodes"]) > 0
    assert graph.number_of_edges() == len(document["edges"]) > 0
    for node in document["nodes"]:
        found = graph.nodes[f"n{node['id']}"]
        assert found["type"] == node["type"]
        assert [found["x"], found["y"], found["z"]] == node["position"]
        for key in CARRIED[node["type"]]:
            assert found[key] == node[key], (node["id"], key)
        if node["type"] == "OBJECT":
            assert found["label"] == node["class"]
            for key in ("class_histogram", "box"):
                assert json.loads(found[key]) == node[key], (node["id"], key)
        if node["type"] == "DOOR":
            assert [found["room_a"], found["room_b"]] == [f"n{room}" for room in node["rooms"]]
    for edge in document["edges"]:
        found = graph.edges[f"n{edge['source']}", f"n{edge['target']}"]
        assert found["type"] == edge["type"]
    print(f"networkx reads {len(graph)} nodes and {graph.number_of_edges()} edges")


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a scene_graph.graphml with networkx and compares it with the scene_graph.json beside it.

Usage: check_graphml.py FOLDER
"""
import json
import os
import sys

import networkx


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
        if node["type"] == "ROOM":
            assert found["name"] == node["name"] and found["area_m2"] == node["area_m2"]
    for edge in document["edges"]:
        found = graph.edges[f"n{edge['source']}", f"n{edge['target']}"]
        assert found["type"] == edge["type"]
    print(f"networkx reads {len(graph)} nodes and {graph.number_of_edges()} edges")


if __name__ == "__main__":
    main(*sys.argv[1:])

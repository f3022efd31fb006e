#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints how the objects, labels and room ids of finished runs compare with the recordings' truth.

Usage: graph_table.py RECORDINGS OUT, where OUT/<scene>/ holds scene_graph.json of 'occusg run' on
RECORDINGS/<scene> and OUT/<scene>.log what it printed.

An object is found when an object of the true one's class has its box centre within 1 m of the true
box's centre; each is matched once, nearest first. It is in the right room when the room that contains
it is the one that covers most of its true room.
"""
import json
import math
import re
import sys
from collections import Counter
from pathlib import Path

REACH_M = 1.0
STEP_M = 0.1


def inside(ring, x, y):
    result = False
    for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
        if (y0 > y) != (y1 > y) and x < (x1 - x0) * (y - y0) / (y1 - y0) + x0:
            result = not result
    return result


def samples(ring):
    xs, ys = [p[0] for p in ring], [p[1] for p in ring]
    for i in range(int((max(xs) - min(xs)) / STEP_M) + 1):
        for j in range(int((max(ys) - min(ys)) / STEP_M) + 1):
            x, y = min(xs) + (i + 0.5) * STEP_M, min(ys) + (j + 0.5) * STEP_M
            if inside(ring, x, y):
                yield x, y


def room_on(truth_room, rooms):
    """Id of the predicted room that covers most of a true one; None when none does."""
    covered = Counter()
    for x, y in samples(truth_room["polygon"]):
        for room in rooms:
            if inside(room["polygon"], x, y):
                covered[room["id"]] += 1
    return max(covered, key=lambda room: (covered[room], -room)) if covered else None


def center(low, high):
    return [(a + b) / 2 for a, b in zip(low, high)]


def matches(truth, found):
    pairs = sorted((math.dist(center(*t["bbox"]), center(*f["box"])), t["id"], f["id"]) for t in truth for f in found
                   if t["label"] == f["class"] and math.dist(center(*t["bbox"]), center(*f["box"])) <= REACH_M)
    of_truth, taken = {}, set()
    for _, t, f in pairs:
        if t not in of_truth and f not in taken:
            of_truth[t] = f
            taken.add(f)
    return of_truth


def seen_ids(recording):
    """Objects with a depth return in some frame; None when the recording does not say."""
    path = recording / "objects.json"
    if not path.is_file():
        return None
    entries = json.loads(path.read_text(encoding="utf-8"))
    entries = entries.get("objects", entries) if isinstance(entries, dict) else entries
    if isinstance(entries, dict):
        entries = [{"id": int(key), **value} for key, value in entries.items()]
    return {entry["id"] for entry in entries if entry.get("pixels", entry.get("pixels_with_depth", 1)) > 0}


def row_of(recording, out):
    truth = json.loads((recording / "rooms.json").read_text(encoding="utf-8"))
    graph = json.loads((out / recording.name / "scene_graph.json").read_text(encoding="utf-8"))
    log = (out / f"{recording.name}.log").read_text(encoding="utf-8")
    seen = seen_ids(recording)
    nodes = {kind: [n for n in graph["nodes"] if n["type"] == kind] for kind in ("OBJECT", "ROOM", "DOOR", "NAVIGATION")}
    objects = [o for o in truth.get("objects", []) if seen is None or o["id"] in seen]
    room_of = {e["target"]: e["source"] for e in graph["edges"] if e["type"] == "ROOM_CONTAINS"}
    on = {room["id"]: room_on(room, nodes["ROOM"]) for room in truth["rooms"]}
    of_truth = matches(objects, nodes["OBJECT"])
    placed = [o for o in objects if o["id"] in of_truth and o.get("room") in on]
    right = [o for o in placed if on[o["room"]] is not None and room_of.get(of_truth[o["id"]]) == on[o["room"]]]
    switches = re.search(r"(\d+) room id switches", log)
    return {"scene": recording.name, "objects": len(objects), "nodes": len(nodes["OBJECT"]), "found": len(of_truth),
            "placed": len(placed), "right": len(right), "doors": len(nodes["DOOR"]),
            "partial": sum(r["state"] == "partial" for r in nodes["ROOM"]), "rooms": len(nodes["ROOM"]),
            "navigation": len(nodes["NAVIGATION"]), "switches": int(switches.group(1)) if switches else None}


def share(part, whole):
    return f"{part / whole:.3f}" if whole else "-"


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    recordings, out = Path(sys.argv[1]), Path(sys.argv[2])
    names = ["scene", "rooms", "partial", "doors", "navigation nodes", "true objects", "object nodes", "found",
             "in the right room", "id switches"]
    print("| " + " | ".join(names) + " |")
    print("|" + " --- |" * len(names))
    rows = [row_of(path, out) for path in sorted(recordings.iterdir())
            if (path / "rooms.json").is_file() and (out / path.name / "scene_graph.json").is_file()]
    total = Counter()
    for row in rows:
        total.update({key: value for key, value in row.items() if key != "scene" and value is not None})
    for row in rows + [{**total, "scene": "**all**"}]:
        print(f"| {row['scene']} | {row['rooms']} | {row['partial']} | {row['doors']} | {row['navigation']} | "
              f"{row['objects']} | {row['nodes']} | {share(row['found'], row['objects'])} | "
              f"{share(row['right'], row['placed'])} | {row['switches']} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())

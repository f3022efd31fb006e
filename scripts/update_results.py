#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of a batch into a Markdown file, between <!-- NAME begin --> and <!-- NAME end -->.

Usage: update_results.py RESULTS_JSON MARKDOWN NAME
"""
import json
import sys
from pathlib import Path

STAGES = ["point_cloud", "occupancy", "free_space", "decomposition", "tracking", "graph", "total"]


def shown(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def estimate(average):
    text = shown(average["value"])
    return f"{text} ({shown(average['low'])}–{shown(average['high'])})" if "low" in average else text


def averages(results, kind):
    """One row a configuration, values with the ends of their 95 % interval."""
    rows = []
    for entry in results["configurations"]:
        scores = entry[kind]
        if "@0.15" not in scores:
            continue
        at = scores["@0.15"]
        values = [at["R"], at["P"], at["F1"], at["mIoU"], at["bF1"], scores["@0.50"]["F1"], scores["@0.75"]["F1"],
                  scores["oS"], scores["uS"]]
        rows.append([entry["name"], str(entry["scenes"]), *[estimate(value) for value in values]])
    return table([f"{kind} mean", "scenes", "R", "P", "F1", "mIoU", "bF1", "F1@.50", "F1@.75", "oS", "uS"], rows)


def scenes(results, configuration):
    rows = []
    for scene in results["scenes"]:
        if scene["configuration"] != configuration or "metrics" not in scene:
            continue
        metrics = scene["metrics"]
        at = metrics["@0.15"]
        values = [at["R"], at["P"], at["F1"], at["mIoU"], at["bF1"], metrics["@0.50"]["F1"], metrics["@0.75"]["F1"],
                  metrics["oS"], metrics["uS"]]
        rows.append([scene["scene"], str(metrics["n_gt"]), str(metrics["n_pred"]), *[shown(value) for value in values]])
    return table(["scene", "GT", "found", "R", "P", "F1", "mIoU", "bF1", "F1@.50", "F1@.75", "oS", "uS"], rows)


def times(results, configuration):
    rows = []
    for scene in results["scenes"]:
        timing = scene.get("timing", {})
        if scene["configuration"] != configuration or "total" not in timing:
            continue
        means = [shown(timing[stage]["mean_ms"], 2) for stage in STAGES]
        total = timing["total"]
        rows.append([scene["scene"], *means, shown(total["max_ms"], 1), shown(total["memory_mib"], 0)])
    return table(["scene", *[f"{stage} ms" for stage in STAGES], "worst frame ms", "peak MiB"], rows)


def main():
    if len(sys.argv) != 4:
        print("usage: update_results.py RESULTS_JSON MARKDOWN NAME", file=sys.stderr)
        return 2
    results = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    path, name = Path(sys.argv[2]), sys.argv[3]
    first = results["configurations"][0]["name"]
    content = "\n\n".join([averages(results, "macro"), averages(results, "micro"),
                           f"Scene by scene, `{first}`:", scenes(results, first),
                           f"Means per call of each stage, `{first}`:", times(results, first)])
    text = path.read_text(encoding="utf-8")
    begin, end = f"<!-- {name} begin -->", f"<!-- {name} end -->"
    if text.count(begin) != 1 or text.count(end) != 1:
        print(f"{path}: needs '{begin}' and '{end}', once each", file=sys.stderr)
        return 1
    head, rest = text.split(begin)
    path.write_text(head + begin + "\n\n" + content + "\n\n" + end + rest.split(end)[1], encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

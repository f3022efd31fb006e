#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the rooms and the run times of finished runs as Markdown tables.

Usage: results_table.py OUT, where OUT/<scene>/ holds metrics.json (of 'occusg eval --json') and
timing.json (of 'occusg run').
"""
import json
import sys
from pathlib import Path

STAGES = ["point_cloud", "occupancy", "free_space", "decomposition", "tracking", "graph", "total"]


def load(path):
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None


def shown(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def row(cells):
    return "| " + " | ".join(cells) + " |"


def room_rows(scenes):
    """One list of numbers a scene, and their plain means; undefined values are left out of a mean."""
    rows = []
    for name, metrics in scenes:
        at, half = metrics["@0.15"], metrics["@0.50"]
        rows.append((name, [metrics["n_gt"], metrics["n_pred"], at["R"], at["P"], at["F1"], at["mIoU"], at["bF1"],
                            half["F1"], metrics["oS"], metrics["uS"]]))
    if rows:
        columns = zip(*(values for _, values in rows))
        known = [[value for value in column if value is not None] for column in columns]
        rows.append(("**macro mean**", [sum(column) / len(column) if column else None for column in known]))
    return rows


def main():
    if len(sys.argv) != 2:
        print("usage: results_table.py OUT", file=sys.stderr)
        return 2
    folders = sorted(path for path in Path(sys.argv[1]).iterdir() if path.is_dir())
    scenes = [(folder.name, load(folder / "metrics.json")) for folder in folders]
    print(row(["scene", "GT", "found", "R", "P", "F1", "mIoU", "bF1", "F1@.50", "oS", "uS"]))
    print(row(["---"] * 11))
    for name, values in room_rows([scene for scene in scenes if scene[1]]):
        counts = [f"{value:.0f}" if value == int(value) else f"{value:.1f}" for value in values[:2]]
        print(row([name, *counts, *[shown(value) for value in values[2:]]]))

    print()
    print(row(["scene", *[f"{stage} ms" for stage in STAGES], "worst frame ms", "peak MiB"]))
    print(row(["---"] * (len(STAGES) + 3)))
    for folder in folders:
        times = load(folder / "timing.json")
        if times:
            means = [shown(times[stage]["mean_ms"], 2) for stage in STAGES]
            total = times["total"]
            print(row([folder.name, *means, shown(total["max_ms"], 1), shown(total["memory_mib"], 0)]))
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the rooms found in 2D maps as a Markdown table, plain / furnished.

Usage: maps_table.py OUT, where OUT/<map>/plain/ and OUT/<map>/furnished/ hold metrics.json (of 'occusg eval --json')
and timing.json (of 'occusg segment').
"""
import json
import sys
from pathlib import Path

KINDS = ["plain", "furnished"]


def numbers(folder):
    metrics = json.loads((folder / "metrics.json").read_text(encoding="utf-8"))
    times = json.loads((folder / "timing.json").read_text(encoding="utf-8"))
    main, half = metrics["@0.15"], metrics["@0.50"]
    return {"gt": metrics["n_gt"], "found": metrics["n_pred"], "R": main["R"], "P": main["P"], "F1": main["F1"],
            "F1@.50": half["F1"], "mIoU": main["mIoU"] or 0.0, "bF1": main["bF1"],
            "ms": times["decomposition"]["mean_ms"]}


def row(cells):
    return "| " + " | ".join(cells) + " |"


def both(pair, key, digits):
    return " / ".join(f"{values[key]:.{digits}f}" for values in pair)


def cells(name, pair, count_digits):
    return [name, f"{pair[0]['gt']:.{count_digits}f}", both(pair, "found", count_digits),
            *[both(pair, key, 3) for key in ("R", "P", "F1", "F1@.50", "mIoU", "bF1")], both(pair, "ms", 0)]


def mean(rows):
    return {key: sum(values[key] for values in rows) / len(rows) for key in rows[0]}


def main():
    if len(sys.argv) != 2:
        print("usage: maps_table.py OUT", file=sys.stderr)
        return 2
    folders = sorted(path for path in Path(sys.argv[1]).iterdir() if (path / "plain" / "metrics.json").is_file())
    if not folders:
        print(f"{sys.argv[1]}: no evaluated map", file=sys.stderr)
        return 1
    pairs = [[numbers(folder / kind) for kind in KINDS] for folder in folders]
    print(row(["map", "GT", "found", "R@.15", "P@.15", "F1@.15", "F1@.50", "mIoU", "bF1", "decomposition ms"]))
    print(row(["---"] * 10))
    for folder, pair in zip(folders, pairs):
        print(row(cells(folder.name, pair, 0)))
    print(row(cells("**macro mean**", [mean(list(column)) for column in zip(*pairs)], 1)))
    return 0


if __name__ == "__main__":
    sys.exit(main())

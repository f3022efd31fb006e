#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The mapping benchmarks as one table and, on the last line, one JSON object.

Usage: mapping_ratios.py RESULT.json...   (Google Benchmark's JSON)
"""
import json
import sys

# The real Kinect recording stands for an office.
NAMES = {"kinect_office": "office"}
WAYS = ("octomap_ms", "octomap_discretized_ms", "exact_ms", "fast_ms", "exact_wall_ms",
        "exact_2_threads_wall_ms")
# What Google Benchmark adds to each row.
OWN_KEYS = {"name", "run_name", "run_type", "time_unit", "family_index", "repetitions", "threads",
            "per_family_instance_index", "repetition_index", "iterations", "real_time"}


def read_rows(paths):
    for path in paths:
        with open(path, encoding="utf-8") as file:
            yield from json.load(file)["benchmarks"]


def integration_summary(row):
    summary = {way: round(row[way + "_ratio"], 1) for way in ("exact", "fast")}
    summary["p95_over_median"] = {way: round(row[way + "_p95_over_median"], 2)
                                  for way in ("exact", "fast")}
    summary["thread_speedup"] = round(row["thread_speedup"], 2)
    summary["bytes_per_m2"] = round(row["bytes_per_m2"])
    return summary


def main():
    result = {}
    print("| scene | " + " | ".join(WAYS) + " |")
    print("| --- |" + " --- |" * len(WAYS))
    for row in read_rows(sys.argv[1:]):
        family, _, rest = row["run_name"].partition("/")
        if family == "integration":
            scene = rest.split("/")[0]
            print(f"| {scene} | " + " | ".join(f"{row[way]:.2f}" for way in WAYS) + " |")
            result[NAMES.get(scene, scene)] = integration_summary(row)
        else:
            result[row["run_name"]] = {key: value for key, value in row.items()
                                       if key not in OWN_KEYS}
    print(json.dumps(result))


if __name__ == "__main__":
    main()

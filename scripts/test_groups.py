#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the tests that ran, by group, from ctest's output.

Fails when a group has no test, when a test was skipped or did not run, and when a test has no group.
Usage: test_groups.py CTEST_JSON LOG GROUP... [-- GROUP_LEFT_OUT...]
"""
import json
import re
import sys

RESULT = re.compile(r"^\s*\d+/\d+ Test\s+#\d+: (.*?) \.*\s*(Passed|\*\*\*\S.*?)\s+[\d.]+ sec", re.MULTILINE)


def groups_of_tests(show_only):
    """Maps the name of each test to its labels."""
    labels = {}
    for test in show_only["tests"]:
        found = [p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"]
        labels[test["name"]] = found[0] if found else []
    return labels


def main():
    arguments = sys.argv[3:]
    split = arguments.index("--") if "--" in arguments else len(arguments)
    groups, left_out = arguments[:split], arguments[split + 1:]
    with open(sys.argv[1], encoding="utf-8") as file:
        labels = groups_of_tests(json.load(file))
    with open(sys.argv[2], encoding="utf-8", errors="replace") as file:
        results = dict(RESULT.findall(file.read()))

    faults = [f"{name} was not run: {results.get(name, 'no result')}" for name, own in labels.items()
              if not set(own) & set(left_out)
              and (name not in results or re.search("Skipped|Not Run|Disabled", results[name]))]
    faults += [f"{name} is in no group" for name, own in labels.items() if not set(own) & set(groups)]
    print("\nTests that ran, by group:")
    for group in groups:
        if group in left_out:
            print(f"  {group:<12}  left out, as asked")
            continue
        ran = sum(group in own and name in results for name, own in labels.items())
        print(f"  {group:<12} {ran:>5}")
        if ran == 0:
            faults.append(f"the group '{group}' is empty")
    for fault in faults:
        print(f"test.sh: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

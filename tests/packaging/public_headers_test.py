#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is installed of the headers is what a user of the library includes, and needs nothing that is not installed.

Usage: public_headers_test.py PROJECT
"""
import pathlib
import re
import sys

MOST_HEADERS = 75


def main():
    root = pathlib.Path(sys.argv[1]) / "occusg_core" / "include"
    headers = {path.relative_to(root).as_posix(): path.read_text() for path in root.rglob("*.hpp")}
    problems = []
    if len(headers) > MOST_HEADERS:
        problems.append("%d headers are installed; at most %d may be" % (len(headers), MOST_HEADERS))
    for name, text in sorted(headers.items()):
        for included in re.findall(r'#include "([^"]+)"', text):
            if included not in headers:
                problems.append("%s includes %s, which is not installed" % (name, included))
    umbrella = headers["occusg/occusg.hpp"]
    for name in ("pipeline/pipeline", "regions/decomposer", "graph/scene_graph"):
        if '"occusg/%s.hpp"' % name not in umbrella:
            problems.append("occusg/occusg.hpp lacks %s.hpp" % name)
    for problem in problems:
        print(problem)
    print("%d public headers" % len(headers))
    return 1 if problems or not headers else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The modules and arrows of docs/architecture.md are those of the code: what each module includes, and what its
libraries are made of.

Usage: architecture_test.py PROJECT
"""
import pathlib
import re
import sys


def drawn(text):
    """Module -> the modules it uses, from the lines 'name --> a, b' of the document."""
    return {name: {used.strip() for used in uses.split(",")} - {"nothing"}
            for name, uses in re.findall(r"^    (\w+) +--> (.+)$", text, re.M)}


def declared(text):
    modules = {}
    for name, body in re.findall(r"^occusg_add_module\((\w+)(.*?)\)$", text, re.M | re.S):
        uses = re.search(r"USES ([a-z ]+)", body)
        modules[name] = set(uses.group(1).split() if uses else []) | ({"base"} if name != "base" else set())
    return modules


def included(core, module, modules):
    """The modules whose headers the files of a module include."""
    found = set()
    if module == "base":
        files = [*(core / "include/occusg").glob("*.hpp"), *(core / "src/base").rglob("*.?pp")]
        files = [file for file in files if file.name != "occusg.hpp"]
    else:
        files = [*(core / "include/occusg" / module).rglob("*.hpp"), *(core / "src" / module).rglob("*.?pp")]
    for file in files:
        for name in re.findall(r'^#include "(?:occusg/)?(\w+)/', file.read_text(), re.M):
            if name in modules:
                found.add(name)
    return found - {module}


def main():
    root = pathlib.Path(sys.argv[1])
    core = root / "occusg_core"
    picture = drawn((root / "docs/architecture.md").read_text())
    code = declared((core / "modules.cmake").read_text())
    problems = []
    if picture != code:
        for name in sorted(set(picture) | set(code)):
            if picture.get(name) != code.get(name):
                problems.append("%s: drawn %s, in modules.cmake %s" % (
                    name, sorted(picture.get(name, [])), sorted(code.get(name, []))))
    for name in code:
        wrong = included(core, name, code) - code[name]
        if wrong:
            problems.append("%s includes headers of %s, which it may not use" % (name, ", ".join(sorted(wrong))))
    for problem in problems:
        print(problem)
    print("%d modules" % len(code))
    return 1 if problems or len(code) < 9 else 0


if __name__ == "__main__":
    sys.exit(main())

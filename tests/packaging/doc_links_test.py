#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every relative link of the documentation leads to a file of the repository.

Usage: doc_links_test.py ROOT
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
documents = [*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("examples/**/*.md")]
assert len(documents) > 10, "where is the documentation?"
dead = []
for document in documents:
    for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", document.read_text(encoding="utf-8")):
        if "://" not in link and not (document.parent / link).exists():
            dead.append(f"{document.relative_to(root)}: {link}")
print("\n".join(dead) or f"{len(documents)} documents, no dead link")
sys.exit(1 if dead else 0)

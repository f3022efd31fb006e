#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Validates a scene_graph.json against its JSON Schema.

Usage: check_schema.py SCHEMA FILE [broken]; with "broken", FILE must not be valid.
"""
import json
import sys

import jsonschema


def main(schema_path, path, wanted="valid"):
    with open(schema_path) as file:
        schema = json.load(file)
    with open(path) as file:
        document = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    errors = list(jsonschema.Draft7Validator(schema).iter_errors(document))
    for error in errors[:5]:
        print(f"{list(error.absolute_path)}: {error.message[:200]}")
    return 0 if bool(errors) == (wanted == "broken") else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

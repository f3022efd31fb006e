#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Opens what 'occusg run' writes with the programs it is meant for.
# Usage: interchange_test.sh schema|graphml|spark_dsg OCCUSG RECORDING SOURCE_FOLDER WORK_FOLDER
set -uo pipefail
what=$1
occusg=$2
recording=$3
source=$4
work=$5
. "$(dirname "${BASH_SOURCE[0]}")/../cli/expectations.sh"
checks=$source/tests/interchange

# check NAME PROGRAM ARGUMENTS...
check() {
  local name=$1
  shift
  "$@" > out.txt 2> err.txt || fail "$name"
}

short_recording short 80
ln -s "$recording/labels" short/labels
cp "$recording"/{rgb.txt,rooms.json,objects.json} short
expect "run" 0 "" run short -o out
case $what in
  schema)
    schema=$source/docs/scene_graph.schema.json
    check "scene_graph.json keeps to its schema" /usr/bin/python3 "$checks/check_schema.py" "$schema" out/scene_graph.json
    sed 's/"region_id":[0-9]*/"region_id":-1/' out/scene_graph.json > spoilt.json
    check "the schema refuses a spoilt file" /usr/bin/python3 "$checks/check_schema.py" "$schema" spoilt.json broken
    ;;
  graphml) check "networkx reads scene_graph.graphml" /usr/bin/python3 "$checks/check_graphml.py" out ;;
  spark_dsg) check "spark_dsg reads scene_graph.dsg.json" "$source/scripts/check_spark_dsg.sh" out ;;
  *) fail "unknown check $what" ;;
esac
finish

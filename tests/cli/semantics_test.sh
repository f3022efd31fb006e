#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Objects as 'occusg run' finds them: with a segmentation model on the colour images, and in label images.
# Usage: semantics_test.sh OCCUSG RECORDING MODELS WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
models=$3
work=$4
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"
frames=12

# objects FOLDER: the object nodes without what depends on the confidence of their source.
objects() { grep '"type":"OBJECT"' "$1/scene_graph.json" | sed -E 's/"(score|class_histogram)":([0-9.]+|\{[^}]*\}),?//g'; }

# label_image FILE WIDTH HEIGHT: object 1 in the middle quarter, nothing elsewhere.
label_image() {
  /usr/bin/python3 - "$@" << 'PYTHON'
import struct
import sys
import zlib

path, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def is_inside(x, y):
    return width <= 4 * x < 3 * width and height <= 4 * y < 3 * height


rows = b"".join(b"\0" + b"".join(struct.pack(">H", is_inside(x, y)) for x in range(width)) for y in range(height))
with open(path, "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PYTHON
}

# labelled NAME LABEL_IMAGE: a short recording that shows the same label image in each frame.
labelled() {
  short_recording "$1" $frames
  mkdir "$1/labels"
  for depth in $(sed '1d; s|.*depth/||' "$1/depth.txt"); do cp "$2" "$1/labels/$depth"; done
  echo '{"objects": [{"id": 1, "label": "table"}]}' > "$1/rooms.json"
}

short_recording coloured $frames
cp "$recording/rgb.txt" coloured
ln -s "$recording/rgb" coloured/rgb
model=(--model "$models/middle.onnx" --classes "$models/classes.txt")

# --- A model that sees a table in the middle quarter of each picture
expect "a model" 0 "" run coloured -o out "${model[@]}"
grep -qE "^  $frames detections, 0 refused" out.txt || fail "a model: not one object in each frame"
[ "$(grep -c '"class":"table".*"type":"OBJECT"' out/scene_graph.json)" -ge 1 ] || fail "a model: no table in the graph"
grep '"type":"OBJECT"' out/scene_graph.json | grep -qv '"class":"table"' && fail "a model: an object of another class"
expect "a model, again" 0 "" run coloured -o again "${model[@]}"
cmp -s out/scene_graph.json again/scene_graph.json || fail "a model: two runs differ"
label_image middle.png 320 240
labelled labels middle.png
expect "label images" 0 "" run labels -o from_labels
[ -n "$(objects out)" ] && [ "$(objects out)" = "$(objects from_labels)" ] ||
  fail "the model's objects are not where label images of the same pixels put them"

# --- Its parameters take effect
# detections NAME YAML EXPECTED: what the model finds with these parameters.
detections() {
  printf 'perception:\n%s\n' "$2" > parameters.yaml
  expect "$1" 0 "" run coloured -o tuned "${model[@]}" --config parameters.yaml
  grep -qE "$3" out.txt || fail "$1: no line with '$3'"
}
detections "minimum confidence below the score" '  model:
    min_confidence: 0.87' "^  $frames detections, 0 refused"
printf 'perception.model.min_confidence: 0.88\n' > confident.yaml
expect "minimum confidence above the score" 0 "" run coloured -o none "${model[@]}" --config confident.yaml
grep -q detections out.txt && fail "minimum confidence above the score: there are detections"
detections "minimum points" '  objects:
    min_points: 19201' "^  0 detections, $frames refused"
expect "confidence out of range" 1 "perception.model.min_confidence is '2'; allowed is [0.001, 1]" \
  run coloured -o none --config <(echo 'perception.model.min_confidence: 2')

# --- What cannot be used as a model: one sentence, before anything is written
# refused NAME TEXT ARGUMENTS...
refused() {
  local name=$1 text=$2
  shift 2
  expect "$name" 1 "$text" run coloured -o refused "$@"
  [ "$(wc -l < err.txt)" -eq 1 ] || fail "$name: more than one sentence"
  [ ! -e refused ] || fail "$name: an output folder was made"
}
refused "a missing model" "nowhere.onnx: is not a file" --model nowhere.onnx --classes "$models/classes.txt"
refused "a missing class file" "nowhere.txt" --model "$models/middle.onnx" --classes nowhere.txt
refused "a model with an unknown layer" "NoSuchOperator" --model "$models/unknown_layer.onnx" --classes "$models/classes.txt"
refused "a model of another shape" "7 x 9" --model "$models/odd_shape.onnx" --classes "$models/classes.txt"
refused "a model without masks" "one_output.onnx: has 1 outputs" --model "$models/one_output.onnx" --classes "$models/classes.txt"
head -c 700 "$models/anchors.onnx" > cut.onnx
refused "a model cut short" "cut.onnx" --model cut.onnx --classes "$models/classes.txt"
printf 'chair\ntable\n' > two.txt
refused "too few class names" "of 3 classes; the list of names has 2" --model "$models/anchors.onnx" --classes two.txt
printf 'chair\n\ntable\n' > gap.txt
refused "a blank class name" "gap.txt:2" --model "$models/anchors.onnx" --classes gap.txt
printf 'chair\n' > one.txt
expect "a class beyond the names" 0 "" run coloured -o unnamed --model "$models/middle.onnx" --classes one.txt
grep -qE "^  0 detections, $frames refused" out.txt || fail "a class beyond the names: it is not counted as refused"

# --- A colour image or label image that cannot be used costs its objects, not its frame
labelled spoilt middle.png
third=$(sed -n '4s|.*depth/||p' spoilt/depth.txt)
fifth=$(sed -n '6s|.*depth/||p' spoilt/depth.txt)
head -c 60 middle.png > "spoilt/labels/$third"
label_image "spoilt/labels/$fifth" 320 100
expect "spoilt label images" 0 "skipped the objects in 2 of $frames frames" run spoilt -o spoilt_out
grep -qF "labels/$third" err.txt || fail "the damaged label image is not named"
grep -qF "labels/$fifth: is 320 x 100 pixels; the aspect ratio of the depth image, 320 x 240, is needed" err.txt ||
  fail "the label image of another size is not named"
grep -qE "^  $frames frames" out.txt || fail "a frame was lost with its label image"
grep -qE "^  $((frames - 2)) detections" out.txt || fail "the other label images were not used"
expect "a damaged label image, strict" 1 "labels/$third" run spoilt -o strict_out --strict
cp middle.png "spoilt/labels/$third"
expect "a label image of another size, strict" 1 "labels/$fifth: is 320 x 100" run spoilt -o strict_out --strict
[ -z "$(ls strict_out 2> /dev/null)" ] || fail "a strict run that failed wrote results"
rm coloured/rgb && mkdir coloured/rgb && cp "$recording"/rgb/* coloured/rgb
echo "no picture" > "coloured/$(sed -n '3s|.* ||p' coloured/rgb.txt)"
expect "a spoilt colour image" 0 "skipped the objects in 1 of $frames frames" run coloured -o colour_out "${model[@]}"
expect "a spoilt colour image, strict" 1 "cannot be decoded" run coloured -o strict_out "${model[@]}" --strict

finish

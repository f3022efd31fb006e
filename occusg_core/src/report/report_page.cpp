// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_page.hpp"

#include "report/html_text.hpp"
#include "report/report_pictures.hpp"
#include "report/report_tables.hpp"
#include "report/room_drawing.hpp"

namespace occusg {
namespace {

constexpr const char* kStyle = R"(
:root { --ink: #1f2328; --soft: #646b73; --line: #d9dde2; --paper: #fff; --accent: #1f5f8b; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.55 Charter, "Bitstream Charter", "Source Serif 4", "DejaVu Serif", Georgia, serif; }
main, header { max-width: 78rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 3rem; }
h1 { font-size: 2.1rem; line-height: 1.15; margin: 0 0 .4rem; font-weight: 600; }
h2 { font-size: 1.35rem; margin: 3rem 0 .3rem; font-weight: 600; }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .4rem; font-weight: 600; }
p.key-line { max-width: none; }
p { max-width: 44rem; margin: .5rem 0 1rem; }
.lead { color: var(--soft); font-size: 1.08rem; }
nav a, a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
nav { margin: 1rem 0 0; font-family: system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
  font-size: .87rem; }
nav a { margin-right: 1.2rem; white-space: nowrap; }
.letter { display: inline-block; min-width: 1.25em; text-align: center; border-radius: .2em;
  background: #e8eef3; color: var(--accent); font: 600 .86em/1.45 system-ui, "DejaVu Sans", sans-serif; }
.wide { overflow-x: auto; margin: .8rem 0 1.8rem; }
table { border-collapse: collapse; font: .84rem/1.3 system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
  font-variant-numeric: tabular-nums; border-top: 2px solid var(--ink);
  border-bottom: 2px solid var(--ink); }
caption { caption-side: top; text-align: left; padding: 0 0 .45rem; color: var(--soft);
  font: italic .95rem/1.4 Charter, "Bitstream Charter", "Source Serif 4", "DejaVu Serif", Georgia, serif; }
th, td { padding: .3rem .55rem; text-align: right; vertical-align: top; white-space: nowrap; }
th:first-child, td.text { text-align: left; }
td.text { white-space: normal; min-width: 24rem; }
thead th { font-weight: 600; vertical-align: bottom; }
thead tr:last-child th { border-bottom: 1px solid var(--ink); }
thead th[colspan] { text-align: center; }
thead th[rowspan] { border-bottom: 1px solid var(--ink); }
tbody th { font-weight: 400; }
tbody tr:nth-child(even) { background: #f7f9fa; }
tfoot th, tfoot td { border-top: 1px solid var(--ink); font-weight: 600; }
td.group, th.group { padding-left: 1.1rem; }
td.best { font-weight: 700; }
td small { display: block; color: var(--soft); font-size: .78em; font-weight: 400; }
.row { display: flex; flex-wrap: wrap; gap: 1rem 1.2rem; align-items: flex-start; }
figure { margin: 0; }
figure svg { display: block; width: 100%; background: #fbfbfa; border: 1px solid var(--line);
  border-radius: 3px; }
figure.scene { flex: 1 1 18rem; max-width: 27rem; }
figure.scene svg { max-height: 26rem; }
figure.room { width: 10.2rem; }
figure.room svg { height: 8.5rem; }
figcaption { font: .8rem/1.4 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: var(--soft);
  padding-top: .3rem; }
figcaption b { color: var(--ink); }
section.scene { break-inside: avoid; }
svg path { fill-rule: evenodd; }
.p { stroke: #fff; stroke-width: 1px; vector-effect: non-scaling-stroke; }
.t, .m { fill: none; stroke: #1f2328; stroke-width: 1.4px; vector-effect: non-scaling-stroke;
  pointer-events: all; }
.m { stroke: #c8372d; stroke-width: 2px; }
.key:first-child { margin-left: 0; }
.key { display: inline-block; width: 1.5em; height: .95em; vertical-align: -.1em; margin: 0 .25em 0 .7em; }
.key.fill { background: #b9d8e6; } .key.no { background: repeating-linear-gradient(45deg, #f4e9e6 0 4px, #dfbcb4 4px 6px); }
.key.line { border: 1.5px solid #1f2328; } .key.miss { border: 2px solid #c8372d; }
.defs { position: absolute; }
footer { max-width: 78rem; margin: 4rem auto 0; padding: 1rem 1.5rem 3rem; color: var(--soft);
  border-top: 1px solid var(--line); font-size: .92rem; }
@media print { .wide { overflow: visible; } body { font-size: 11px; } }
)";

constexpr const char* kDefinitions = R"(<h2 id="definitions">What the numbers are</h2>
<p><b>Matching.</b> Predicted and annotated rooms are assigned one to one so that the sum of their
intersections over unions (IoU) is largest; a match is valid from an IoU of .15 (the paper's), .50 or
.75. <b>R</b> is the share of annotated rooms found, <b>P</b> the share of predictions that are one,
<b>F1</b> their harmonic mean, <b>mIoU</b> the mean over valid matches, <b>bF1</b> how well the outlines
of matches agree within 0.25 m.</p>
<p><b>Segmentation.</b> <b>oS</b> is the share of annotated rooms that share 0.1 m² or more with several
predictions, <b>uS</b> the reverse; a scene is <b>severe</b> when fewer than a quarter of its rooms are
predicted or found.</p>
<p><b>Averages.</b> Small figures are 95 % intervals from 2 000 bootstrap samples of the scenes. A run
that failed counts as one that found no rooms; a missing prediction is left out. Values that are
undefined, such as the mIoU of a scene without a match, are left out of their mean.</p>
)";

std::string count(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string alignmentSentence(const std::string& alignment) {
  if (alignment == "none") return "Predictions and truth share one frame; nothing was aligned.";
  return "The truth was moved onto each prediction (alignment: " + escaped(alignment) + ").";
}

std::string pictureKey() {
  return "<p class=\"key-line\"><span class=\"key fill\"></span>predicted room with a match "
         "<span class=\"key no\"></span>prediction without one "
         "<span class=\"key line\"></span>annotated room "
         "<span class=\"key miss\"></span>annotated room not found at IoU .50</p>\n";
}

std::string section(const std::string& id, const std::string& heading, const std::string& content) {
  if (content.empty()) return "";
  return "<h2 id=\"" + id + "\">" + heading + "</h2>\n" + content;
}

}  // namespace

std::string reportPage(const BatchResults& batch, const std::string& title) {
  const std::string name = escaped(title);
  const std::string problems = problemTable(batch);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         name + "</title>\n<style>" + kStyle + "</style></head>\n<body>\n" + drawingPatterns() +
         "<header><h1>" + name + "</h1>\n<p class=\"lead\">" + count(batch.scenes.size(), "scene") +
         " under " + count(batch.configurations.size(), "configuration") + ". " +
         alignmentSentence(batch.alignment) +
         "</p>\n<nav><a href=\"#averages\">Averages</a><a href=\"#scenes\">Scenes</a>"
         "<a href=\"#more\">Beyond the paper</a><a href=\"#time\">Run time</a>"
         "<a href=\"#worst\">Worst rooms</a><a href=\"#pictures\">Pictures</a>" +
         (problems.empty() ? "" : "<a href=\"#trouble\">Problems</a>") +
         "<a href=\"#definitions\">Definitions</a></nav></header>\n<main>\n" +
         section("averages", "Averages", summaryTables(batch)) +
         section("scenes", "Scene by scene", sceneTables(batch) + segmentationTable(batch)) +
         section("more", "Beyond the paper", companionTables(batch)) +
         section("time", "Run time", runTimeTable(batch)) +
         section("worst", "Rooms found worst", pictureKey() + worstRooms(batch)) +
         section("pictures", "Every scene, worst first", scenePictures(batch)) +
         section("trouble", "Problems", problems) + kDefinitions +
         "</main>\n<footer>Made by <code>occusg batch</code>.</footer>\n</body></html>\n";
}

}  // namespace occusg

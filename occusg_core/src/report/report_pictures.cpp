// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_pictures.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "report/html_text.hpp"
#include "report/report_cells.hpp"
#include "report/room_drawing.hpp"

namespace occusg {
namespace {

constexpr std::size_t kWorstRooms = 12;              ///< A configuration.
constexpr std::size_t kMaxPictureBytes = 2'000'000;  ///< Of all scene pictures together.
constexpr double kCloseUpMargin_m = 1.0;
constexpr double kContactShare = 0.1;
constexpr double kMergedShare = 0.5;

/// An annotated room and how it was found.
struct JudgedRoom {
  const SceneResult* result = nullptr;
  std::size_t truth = 0;  ///< Index in the result's annotated rooms.
  double iou = 0.0;
};

double iouOf(const RoomMetrics& metrics, int truth_id) {
  const auto pair =
      std::find_if(metrics.matched.begin(), metrics.matched.end(),
                   [truth_id](const MatchedRooms& m) { return m.truth_id == truth_id; });
  return pair == metrics.matched.end() ? 0.0 : pair->iou;
}

/// Worst first; among equals larger rooms first.
std::vector<JudgedRoom> judgedRooms(const BatchResults& batch, const std::string& configuration) {
  std::vector<JudgedRoom> rooms;
  for (const SceneResult& result : batch.results) {
    if (result.configuration != configuration || !result.metrics) continue;
    for (std::size_t t = 0; t < result.truth.size(); ++t)
      rooms.push_back({&result, t, iouOf(*result.metrics, result.truth[t].id)});
  }
  std::stable_sort(rooms.begin(), rooms.end(), [](const JudgedRoom& a, const JudgedRoom& b) {
    if (a.iou != b.iou) return a.iou < b.iou;
    return area(a.result->truth[a.truth]) > area(b.result->truth[b.truth]);
  });
  return rooms;
}

/// How many other annotated rooms lie mostly within `predicted`.
std::size_t othersWithin(const EvaluatedRoom& predicted, const SceneResult& result,
                         std::size_t truth) {
  std::size_t others = 0;
  for (std::size_t t = 0; t < result.truth.size(); ++t) {
    if (t == truth) continue;
    if (intersectionArea(predicted, result.truth[t]) >= kMergedShare * area(result.truth[t]))
      ++others;
  }
  return others;
}

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// What became of the room, in a few words.
std::string fateOf(const JudgedRoom& room) {
  const SceneResult& result = *room.result;
  const EvaluatedRoom& truth = result.truth[room.truth];
  const EvaluatedRoom* largest = nullptr;
  double largest_common = 0.0;
  std::size_t pieces = 0;
  for (const EvaluatedRoom& predicted : result.predicted) {
    const double common = intersectionArea(predicted, truth);
    if (common >= kContactShare * area(truth)) ++pieces;
    if (common <= largest_common) continue;
    largest_common = common;
    largest = &predicted;
  }
  if (pieces == 0 || largest == nullptr) return "not found";
  if (const std::size_t others = othersWithin(*largest, result, room.truth); others > 0)
    return "merged with " + plural(others, "room");
  if (pieces > 1) return "split into " + std::to_string(pieces);
  if (largest_common < kMergedShare * area(truth)) return "found in part";
  return area(*largest) > 1.5 * area(truth) ? "found too large" : "outline off";
}

Bounds2 closeUp(const EvaluatedRoom& room) {
  Bounds2 all = bounds(room.parts.front());
  for (const Polygon& part : room.parts) {
    const Bounds2 box = bounds(part);
    all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y)};
    all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y)};
  }
  return {{all.min.x - kCloseUpMargin_m, all.min.y - kCloseUpMargin_m},
          {all.max.x + kCloseUpMargin_m, all.max.y + kCloseUpMargin_m}};
}

std::string closeUpFigure(const JudgedRoom& room) {
  const EvaluatedRoom& truth = room.result->truth[room.truth];
  const std::string name = room.result->truth_labels[room.truth] + " " + std::to_string(truth.id);
  const std::string label = name + " of " + room.result->scene + ", " + fateOf(room);
  return "<figure class=\"room\">" + roomDrawing(*room.result, {closeUp(truth), label}) +
         "<figcaption><b>" + shownShare(room.iou) + "</b> " + escaped(fateOf(room)) + "<br>" +
         escaped(room.result->scene) + ", " + escaped(name) + "</figcaption></figure>\n";
}

std::string sceneCaption(const BatchResults& batch, const SceneResult& result) {
  const auto& names = batch.configurations;
  const auto index = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), result.configuration) - names.begin());
  std::string caption = "<b class=\"letter\">" + letterOf(index) + "</b> ";
  if (!result.metrics) return caption + "no truth";
  const RoomMetrics& metrics = *result.metrics;
  return caption + std::to_string(metrics.n_predicted) + " of " + std::to_string(metrics.n_truth) +
         " rooms, F1 " + shownShare(metrics.at.front().f1) + ", at .50 " +
         shownShare(metrics.at[1].f1);
}

/// F1 at 0.5 of the first configuration that has one; scenes without a truth come last.
double sortKey(const BatchResults& batch, const std::string& scene) {
  for (const std::string& name : batch.configurations) {
    const SceneResult* result = resultOf(batch, name, scene);
    if (result != nullptr && result->metrics) return result->metrics->at[1].f1;
  }
  return 2.0;
}

std::string sceneBlock(const BatchResults& batch, const std::string& scene) {
  std::string figures;
  for (const std::string& name : batch.configurations) {
    const SceneResult* result = resultOf(batch, name, scene);
    if (result == nullptr || (result->predicted.empty() && result->truth.empty())) continue;
    std::string label = scene;
    label.append(", ").append(name);
    figures += "<figure class=\"scene\">" + roomDrawing(*result, {boundsOf(*result), label}) +
               "<figcaption>" + sceneCaption(batch, *result) + "</figcaption></figure>\n";
  }
  if (figures.empty()) return "";
  return "<section class=\"scene\"><h3>" + escaped(scene) + "</h3><div class=\"row\">" + figures +
         "</div></section>\n";
}

}  // namespace

std::string worstRooms(const BatchResults& batch) {
  std::string html;
  for (std::size_t i = 0; i < batch.configurations.size(); ++i) {
    const auto rooms = judgedRooms(batch, batch.configurations[i]);
    if (rooms.empty()) continue;
    html += "<h3><b class=\"letter\">" + letterOf(i) + "</b> " + escaped(batch.configurations[i]) +
            "</h3><div class=\"row\">";
    for (std::size_t r = 0; r < std::min(kWorstRooms, rooms.size()); ++r)
      html += closeUpFigure(rooms[r]);
    html += "</div>\n";
  }
  return html;
}

std::string scenePictures(const BatchResults& batch) {
  std::vector<std::string> scenes = batch.scenes;
  std::stable_sort(scenes.begin(), scenes.end(), [&](const std::string& a, const std::string& b) {
    return sortKey(batch, a) < sortKey(batch, b);
  });
  std::string html;
  std::size_t left_out = 0;
  for (const std::string& scene : scenes) {
    const std::string block = sceneBlock(batch, scene);
    if (html.size() + block.size() > kMaxPictureBytes) {
      ++left_out;
    } else {
      html += block;
    }
  }
  if (left_out > 0) {
    html += "<p>The pictures of " + plural(left_out, "scene") +
            " found better are left out to keep this page small.</p>\n";
  }
  return html;
}

}  // namespace occusg

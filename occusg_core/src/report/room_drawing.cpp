// SPDX-License-Identifier: BSD-3-Clause
#include "report/room_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "occusg/io/room_color.hpp"
#include "report/html_text.hpp"

namespace occusg {
namespace {

constexpr double kMargin_m = 0.4;
constexpr double kUnitsPerMetre = 100.0;
constexpr double kFoundIou = 0.5;
/// Pictures stay readable and small however far a stray room lies out.
constexpr double kLongestSide_m = 1000.0;

/// The annotated room of each predicted one, and how well it is found.
struct Matches {
  std::map<int, int> truth_of_predicted;  ///< Valid matches only.
  std::map<int, double> iou_of_truth;
};

Matches matchesOf(const SceneResult& result) {
  Matches matches;
  if (!result.metrics) return matches;
  for (const MatchedRooms& pair : result.metrics->matched) {
    if (isValidMatch(pair, result.metrics->at.front().threshold))
      matches.truth_of_predicted[pair.predicted_id] = pair.truth_id;
    matches.iou_of_truth[pair.truth_id] = pair.iou;
  }
  return matches;
}

/// A path in the drawing's own units, relative where that is shorter.
class PathText {
 public:
  explicit PathText(const Bounds2& bounds) : bounds_(bounds) {}

  void add(const Polygon& polygon) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] long toX(double x) const {
    return std::lround((x - bounds_.min.x) * kUnitsPerMetre);
  }
  [[nodiscard]] long toY(double y) const {
    return std::lround((bounds_.max.y - y) * kUnitsPerMetre);
  }

  void add(const Ring& ring) {
    long x = 0, y = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const long to_x = toX(ring[i].x), to_y = toY(ring[i].y);
      const long dx = to_x - x, dy = to_y - y;
      if (i == 0) {
        text_ += "M" + std::to_string(to_x) + " " + std::to_string(to_y);
      } else if (dx != 0 && dy != 0) {
        text_ += "l" + std::to_string(dx) + (dy < 0 ? "" : " ") + std::to_string(dy);
      } else if (dx != 0) {
        text_ += "h" + std::to_string(dx);
      } else if (dy != 0) {
        text_ += "v" + std::to_string(dy);
      }
      x = to_x;
      y = to_y;
    }
    text_ += "z";
  }

  Bounds2 bounds_;
  std::string text_;
};

bool overlaps(const Bounds2& a, const Bounds2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

/// Empty when nothing of the room is within `bounds`.
std::string pathOf(const EvaluatedRoom& room, const Bounds2& bounds) {
  PathText path(bounds);
  bool shows = false;
  for (const Polygon& part : room.parts) {
    path.add(part);
    shows = shows || overlaps(occusg::bounds(part), bounds);
  }
  return shows ? path.text() : std::string();
}

std::string inHex(const RgbColor& color) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color.r, color.g, color.b);
  return text;
}

std::string predictedPaths(const SceneResult& result, const Matches& matches,
                           const Bounds2& bounds) {
  constexpr ColorTone kTone{84.0, 30.0};
  std::string svg;
  for (const EvaluatedRoom& room : result.predicted) {
    const std::string path = pathOf(room, bounds);
    if (path.empty()) continue;
    const auto match = matches.truth_of_predicted.find(room.id);
    const std::string fill = match == matches.truth_of_predicted.end()
                                 ? "url(#hatch)"
                                 : inHex(roomColor(match->second, kTone));
    svg.append("<path class=\"p\" fill=\"").append(fill);
    svg.append("\" d=\"").append(path).append("\"/>");
  }
  return svg;
}

std::string truthPaths(const SceneResult& result, const Matches& matches, const Bounds2& bounds) {
  std::string missed, found;
  for (std::size_t i = 0; i < result.truth.size(); ++i) {
    const EvaluatedRoom& room = result.truth[i];
    const std::string path = pathOf(room, bounds);
    if (path.empty()) continue;
    const auto match = matches.iou_of_truth.find(room.id);
    const double iou = match == matches.iou_of_truth.end() ? 0.0 : match->second;
    const bool is_found = iou >= kFoundIou;
    const std::string title =
        result.truth_labels[i] + " " + std::to_string(room.id) + ", IoU " + shownShare(iou);
    (is_found ? found : missed) += std::string("<path class=\"") + (is_found ? "t" : "m") +
                                   "\" d=\"" + path + "\"><title>" + escaped(title) +
                                   "</title></path>";
  }
  return found + missed;  // red on top
}

}  // namespace

Bounds2 boundsOf(const SceneResult& result) {
  Bounds2 all;
  bool is_first = true;
  for (const auto* rooms : {&result.predicted, &result.truth}) {
    for (const EvaluatedRoom& room : *rooms) {
      for (const Polygon& part : room.parts) {
        const Bounds2 box = bounds(part);
        if (is_first) all = box;
        is_first = false;
        all.min = {std::min(all.min.x, box.min.x), std::min(all.min.y, box.min.y)};
        all.max = {std::max(all.max.x, box.max.x), std::max(all.max.y, box.max.y)};
      }
    }
  }
  all.max = {std::min(all.max.x, all.min.x + kLongestSide_m),
             std::min(all.max.y, all.min.y + kLongestSide_m)};
  return {{all.min.x - kMargin_m, all.min.y - kMargin_m},
          {all.max.x + kMargin_m, all.max.y + kMargin_m}};
}

std::string roomDrawing(const SceneResult& result, const DrawnPart& part) {
  const Matches matches = matchesOf(result);
  const auto inUnits = [](double length_m) {
    return std::to_string(std::max(1L, std::lround(length_m * kUnitsPerMetre)));
  };
  return "<svg role=\"img\" aria-label=\"" + escaped(part.label) + "\" viewBox=\"0 0 " +
         inUnits(part.bounds.max.x - part.bounds.min.x) + " " +
         inUnits(part.bounds.max.y - part.bounds.min.y) + "\">" +
         predictedPaths(result, matches, part.bounds) + truthPaths(result, matches, part.bounds) +
         "</svg>";
}

std::string drawingPatterns() {
  return "<svg width=\"0\" height=\"0\" class=\"defs\" aria-hidden=\"true\"><defs><pattern "
         "id=\"hatch\" width=\"16\" height=\"16\" patternUnits=\"userSpaceOnUse\" "
         "patternTransform=\"rotate(45)\"><rect width=\"16\" height=\"16\" fill=\"#f4e9e6\"/>"
         "<rect width=\"5\" height=\"16\" fill=\"#dfbcb4\"/></pattern></defs></svg>\n";
}

}  // namespace occusg

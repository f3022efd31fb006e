// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/relation_metrics.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "evaluation/assignment.hpp"

namespace occusg {
namespace {

double countRatio(std::size_t a, std::size_t b) {
  return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
}

/// Annotated room of each predicted one that has a valid match.
std::map<int, int> truthOfPredicted(const std::vector<MatchedRooms>& matched, double threshold) {
  std::map<int, int> truth_of;
  for (const MatchedRooms& pair : matched)
    if (isValidMatch(pair, threshold)) truth_of[pair.predicted_id] = pair.truth_id;
  return truth_of;
}

std::set<std::pair<int, int>> distinct(const std::vector<RoomPair>& pairs) {
  std::set<std::pair<int, int>> result;
  for (const RoomPair& pair : pairs)
    if (pair.a != pair.b) result.insert(std::minmax(pair.a, pair.b));
  return result;
}

/// The pairs of the one-to-one assignment with most pairs within `tolerance_m`, nearer ones first.
std::vector<std::pair<std::size_t, std::size_t>> nearestPairs(
    const std::vector<std::vector<double>>& distances_m, double tolerance_m) {
  if (distances_m.empty()) return {};
  // Any pair more outweighs all nearness together.
  const double pair_weight = static_cast<double>(distances_m.size()) + 1.0;
  auto weights = distances_m;
  for (std::vector<double>& row : weights) {
    for (double& value : row)
      value = value <= tolerance_m ? pair_weight + 1.0 - value / tolerance_m : 0.0;
  }
  const std::vector<int> columns = maxSumAssignment(weights);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t row = 0; row < columns.size(); ++row) {
    if (columns[row] < 0) continue;
    const auto column = static_cast<std::size_t>(columns[row]);
    if (distances_m[row][column] <= tolerance_m) pairs.emplace_back(row, column);
  }
  return pairs;
}

/// Far beyond any tolerance, for what must not be paired.
constexpr double kNever_m = 1e9;

std::string comparable(const std::string& label) {
  static const std::map<std::string, std::string> kSynonyms{
      {"couch", "sofa"},           {"tv", "television"},       {"monitor", "television"},
      {"tvmonitor", "television"}, {"diningtable", "table"},   {"desk", "table"},
      {"pottedplant", "plant"},    {"fridge", "refrigerator"}, {"singlebed", "bed"},
      {"doublebed", "bed"},        {"armchair", "chair"},      {"officechair", "chair"}};
  std::string plain;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto synonym = kSynonyms.find(plain);
  return synonym == kSynonyms.end() ? plain : synonym->second;
}

}  // namespace

std::optional<double> RelationScore::recall() const {
  return n_truth == 0 ? std::nullopt : std::optional<double>(countRatio(found, n_truth));
}

std::optional<double> RelationScore::precision() const {
  return n_truth == 0 ? std::nullopt : std::optional<double>(countRatio(found, n_predicted));
}

std::optional<double> RelationScore::f1() const {
  return n_truth == 0 ? std::nullopt
                      : std::optional<double>(countRatio(2 * found, n_truth + n_predicted));
}

std::optional<double> ObjectScore::containment() const {
  return in_a_room == 0 ? std::nullopt
                        : std::optional<double>(countRatio(in_right_room, in_a_room));
}

RelationScore adjacencyScore(const std::vector<RoomPair>& predicted,
                             const std::vector<RoomPair>& truth,
                             const std::vector<MatchedRooms>& matched, double threshold) {
  const auto truth_of = truthOfPredicted(matched, threshold);
  const auto predicted_pairs = distinct(predicted);
  const auto truth_pairs = distinct(truth);
  RelationScore score{truth_pairs.size(), predicted_pairs.size(), 0};
  for (const auto& [a, b] : predicted_pairs) {
    const auto truth_a = truth_of.find(a);
    const auto truth_b = truth_of.find(b);
    if (truth_a == truth_of.end() || truth_b == truth_of.end()) continue;
    score.found += truth_pairs.count(std::minmax(truth_a->second, truth_b->second));
  }
  return score;
}

RelationScore doorScore(const std::vector<Segment2>& predicted,
                        const std::vector<Segment2>& truth) {
  std::vector<std::vector<double>> distances;
  for (const Segment2& crossing : predicted) {
    distances.emplace_back();
    for (const Segment2& door : truth)
      distances.back().push_back(distance(door, midpoint(crossing)));
  }
  return {truth.size(), predicted.size(), nearestPairs(distances, kDoorTolerance_m).size()};
}

ObjectScore objectScore(const std::vector<PlacedObject>& predicted,
                        const std::vector<PlacedObject>& truth,
                        const std::vector<MatchedRooms>& matched, double threshold) {
  std::vector<std::vector<double>> distances;
  for (const PlacedObject& p : predicted) {
    distances.emplace_back();
    for (const PlacedObject& t : truth) {
      distances.back().push_back(
          comparable(p.label) == comparable(t.label) ? distance(p.position, t.position) : kNever_m);
    }
  }
  const auto pairs = nearestPairs(distances, kObjectTolerance_m);
  const auto truth_of = truthOfPredicted(matched, threshold);
  ObjectScore score;
  score.detection = {truth.size(), predicted.size(), pairs.size()};
  double distance_sum_m = 0.0;
  for (const auto& [p, t] : pairs) {
    distance_sum_m += distances[p][t];
    if (!truth[t].room_id) continue;
    ++score.in_a_room;
    if (!predicted[p].room_id) continue;
    const auto room = truth_of.find(*predicted[p].room_id);
    if (room != truth_of.end() && room->second == *truth[t].room_id) ++score.in_right_room;
  }
  if (!pairs.empty()) score.mean_distance_m = distance_sum_m / static_cast<double>(pairs.size());
  return score;
}

}  // namespace occusg

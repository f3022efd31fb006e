// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {

/// How many of a kind there are, and how many of the predicted are right.
struct RelationScore {
  std::size_t n_truth = 0;
  std::size_t n_predicted = 0;
  std::size_t found = 0;
  [[nodiscard]] std::optional<double> recall() const;     ///< Undefined without a truth.
  [[nodiscard]] std::optional<double> precision() const;  ///< Undefined without a truth, else 0.
  [[nodiscard]] std::optional<double> f1() const;         ///< Undefined without a truth.
};

/// Two rooms that are joined, in any order.
struct RoomPair {
  int a = 0;
  int b = 0;
};

/// Predicted adjacency against the annotated one: a predicted pair is right when both rooms have a
/// valid match (IoU >= `threshold`) and the annotated rooms are joined. A pair named twice counts
/// once; a pair with a room that has no match is wrong.
[[nodiscard]] RelationScore adjacencyScore(const std::vector<RoomPair>& predicted,
                                           const std::vector<RoomPair>& truth,
                                           const std::vector<MatchedRooms>& matched,
                                           double threshold);

/// Maximum distance from the middle of a predicted crossing to the segment of the annotated door
/// it counts as [m].
inline constexpr double kDoorTolerance_m = 0.5;

/// Predicted crossings against annotated doors, whatever rooms they join: the one-to-one assignment
/// that finds most doors within `kDoorTolerance_m`.
[[nodiscard]] RelationScore doorScore(const std::vector<Segment2>& predicted,
                                      const std::vector<Segment2>& truth);

/// An object and the room that holds it.
struct PlacedObject {
  std::string label;
  Point2 position;  ///< Centre, map frame [m].
  std::optional<int> room_id;
};

/// Objects match when their centres are at most so far apart [m].
inline constexpr double kObjectTolerance_m = 1.0;

/// How well objects and their rooms were found.
struct ObjectScore {
  RelationScore detection;
  std::size_t in_a_room = 0;              ///< Matched objects whose annotation names a room.
  std::size_t in_right_room = 0;          ///< Those whose predicted room is the match of that room.
  std::optional<double> mean_distance_m;  ///< Of matched centres.
  /// in_right_room / in_a_room; undefined without one.
  [[nodiscard]] std::optional<double> containment() const;
};

/// Predicted objects against annotated ones, one to one by class and centre, and whether they are
/// in the right room. Classes agree regardless of case, of '_', '-' and ' ', and of a few synonyms
/// (couch and sofa, ...). A predicted room counts as the annotated one it has a valid match with.
[[nodiscard]] ObjectScore objectScore(const std::vector<PlacedObject>& predicted,
                                      const std::vector<PlacedObject>& truth,
                                      const std::vector<MatchedRooms>& matched, double threshold);

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/evaluation/relation_metrics.hpp"

#include <gtest/gtest.h>

namespace occusg {
namespace {

/// Predicted 11, 12, 13 are annotated 1, 2, 3; the last overlaps too little.
std::vector<MatchedRooms> matches() {
  return {{11, 1, 0.9, 1.0}, {12, 2, 0.5, 1.0}, {13, 3, 0.1, 1.0}};
}

TEST(RelationMetrics, AdjacencyIsComparedThroughTheMatches) {
  const RelationScore score =
      adjacencyScore({{12, 11}, {11, 13}, {11, 12}, {11, 99}}, {{1, 2}, {1, 3}}, matches(), 0.15);
  EXPECT_EQ(score.n_predicted, 3U) << "a pair named twice counts once";
  EXPECT_EQ(score.n_truth, 2U);
  EXPECT_EQ(score.found, 1U) << "13 has no valid match";
  EXPECT_DOUBLE_EQ(score.recall().value(), 0.5);
  EXPECT_DOUBLE_EQ(score.precision().value(), 1.0 / 3);
  EXPECT_DOUBLE_EQ(score.f1().value(), 0.4);
}

TEST(RelationMetrics, AdjacencyOfRoomsThatAreNotJoinedIsWrong) {
  EXPECT_EQ(adjacencyScore({{11, 12}}, {{1, 3}}, matches(), 0.15).found, 0U);
}

TEST(RelationMetrics, NothingPredictedScoresZeroAndNoTruthNothing) {
  const RelationScore none = adjacencyScore({}, {{1, 2}}, matches(), 0.15);
  EXPECT_EQ(none.recall(), 0.0);
  EXPECT_EQ(none.precision(), 0.0);
  EXPECT_EQ(none.f1(), 0.0);
  const RelationScore no_truth = adjacencyScore({{11, 12}}, {}, matches(), 0.15);
  EXPECT_FALSE(no_truth.recall() || no_truth.precision() || no_truth.f1());
}

TEST(RelationMetrics, DoorIsFoundWhenACrossingsMiddleIsNearIt) {
  const Segment2 door{{4, 1}, {4, 2}};
  EXPECT_EQ(doorScore({{{4.3, 1}, {4.3, 2}}}, {door}).found, 1U);
  EXPECT_EQ(doorScore({{{4.6, 1}, {4.6, 2}}}, {door}).found, 0U);
  EXPECT_EQ(doorScore({{{4, 2}, {4, 2.8}}}, {door}).found, 1U) << "0.4 m beside its end";
}

TEST(RelationMetrics, ACrossingFindsOneDoorOnly) {
  const Segment2 left{{0, 0}, {1, 0}}, right{{1.2, 0}, {2.2, 0}};
  const Segment2 between{{0.6, 0}, {1.6, 0}}, on_right{{1.3, 0}, {2.1, 0}};
  EXPECT_EQ(doorScore({between}, {left, right}).found, 1U);
  EXPECT_EQ(doorScore({between, on_right}, {left, right}).found, 2U)
      << "the nearest pair must not cost the other its door";
  EXPECT_EQ(doorScore({}, {left}).recall(), 0.0);
  EXPECT_FALSE(doorScore({left}, {}).f1().has_value());
}

TEST(RelationMetrics, ObjectsMatchByClassAndPlaceAndCountInTheirRoom) {
  const std::vector<PlacedObject> truth{
      {"dining_table", {1, 1}, 1}, {"sofa", {5, 1}, 2}, {"chair", {2, 2}, 1}, {"lamp", {9, 9}, 3}};
  const std::vector<PlacedObject> predicted{{"Dining Table", {1, 1.5}, 11},
                                            {"couch", {5, 1}, 11},
                                            {"plant", {2, 2}, 11},
                                            {"lamp", {9, 10.5}, 13}};
  const ObjectScore score = objectScore(predicted, truth, matches(), 0.15);
  EXPECT_EQ(score.detection.found, 2U) << "a plant is no chair, a lamp 1.5 m off no match";
  EXPECT_DOUBLE_EQ(score.detection.recall().value(), 0.5);
  EXPECT_EQ(score.in_a_room, 2U);
  EXPECT_EQ(score.in_right_room, 1U) << "the couch is put into the table's room";
  EXPECT_DOUBLE_EQ(score.containment().value(), 0.5);
  EXPECT_DOUBLE_EQ(score.mean_distance_m.value(), 0.25);
}

TEST(RelationMetrics, ObjectInNoRoomIsInTheWrongOne) {
  const ObjectScore score =
      objectScore({{"bed", {0, 0}, {}}}, {{"bed", {0, 0}, 1}}, matches(), 0.15);
  EXPECT_EQ(score.containment(), 0.0);
}

TEST(RelationMetrics, WithoutObjectsNothingIsDefined) {
  const ObjectScore score = objectScore({}, {}, {}, 0.15);
  EXPECT_FALSE(score.containment() || score.mean_distance_m || score.detection.f1());
}

}  // namespace
}  // namespace occusg

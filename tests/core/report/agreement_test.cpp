// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "occusg/evaluation/room_metrics.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr double kAgreement = 1e-6;

std::vector<EvaluatedRoom> roomsOfFile(const std::string& path) {
  std::vector<EvaluatedRoom> rooms;
  for (const RoomRecord& record : readRooms(path, RingOrder::kAsWritten).rooms)
    if (auto room = roomFrom(record.id, record.polygon, "rooms.json"))
      rooms.push_back(*std::move(room));
  return rooms;
}

/// Every value of `theirs` is in `ours`.
void expectAgreement(const json& ours, const json& theirs, const std::string& where) {
  if (theirs.is_object()) {
    for (const auto& [key, value] : theirs.items()) {
      ASSERT_TRUE(ours.contains(key)) << where << " " << key;
      expectAgreement(ours.at(key), value, where + " " + key);
    }
  } else if (theirs.is_array()) {
    ASSERT_EQ(ours.size(), theirs.size()) << where;
    for (std::size_t i = 0; i < theirs.size(); ++i) expectAgreement(ours[i], theirs[i], where);
  } else if (theirs.is_number()) {
    ASSERT_TRUE(ours.is_number()) << where;
    EXPECT_NEAR(ours.get<double>(), theirs.get<double>(), kAgreement) << where;
  } else {
    EXPECT_EQ(ours, theirs) << where;
  }
}

class IndependentMetrics : public ::testing::TestWithParam<const char*> {};

TEST_P(IndependentMetrics, AgreeUnderEveryAlignment) {
  const std::string folder = std::string(OCCUSG_TEST_DATA) + "/evaluation/" + GetParam();
  const auto predicted = roomsOfFile(folder + "/rooms.json");
  const auto truth = roomsOfFile(folder + "/truth.json");
  ASSERT_FALSE(predicted.empty());
  const json theirs = json::parse(readFile(folder + "/metrics.json", 1 << 20));
  for (const auto& [name, alignment] :
       {std::pair{"none", Alignment::kNone}, std::pair{"centroid", Alignment::kCentroid},
        std::pair{"search", Alignment::kSearch}}) {
    RoomMetricsOptions options;
    options.alignment = alignment;
    const json ours = json::parse(toJson(evaluateRooms(predicted, truth, options)));
    expectAgreement(ours, theirs.at(name), std::string(GetParam()) + " " + name);
  }
}

INSTANTIATE_TEST_SUITE_P(Recordings, IndependentMetrics,
                         ::testing::Values("apt_d01", "turtlebot3_house"));

}  // namespace
}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>
#include <occusg/MappingLiveConfig.h>
#include <occusg/SceneGraphLiveConfig.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "mapping_settings.hpp"
#include "scene_graph_settings.hpp"

namespace occusg_ros {
namespace {

/// Name -> value, as the table of a node's parameters writes it.
template <typename LiveConfig>
std::map<std::string, std::string> valuesIn(const LiveConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  std::map<std::string, std::string> values;
  for (const auto& value : message.doubles) values[value.name] = occusg::shortestText(value.value);
  for (const auto& value : message.ints) values[value.name] = std::to_string(value.value);
  for (const auto& value : message.bools) values[value.name] = value.value ? "true" : "false";
  return values;
}

/// What can change live has the range, the default and the description of the table the node is
/// checked by.
template <typename LiveConfig, typename Settings>
void expectTheTableSaysTheSame(std::size_t count) {
  Settings settings;
  const std::vector<occusg::Parameter> table = parametersOf(settings);
  const auto defaults = valuesIn(LiveConfig::__getDefault__());
  const auto least = valuesIn(LiveConfig::__getMin__());
  const auto most = valuesIn(LiveConfig::__getMax__());
  EXPECT_EQ(defaults.size(), count);
  for (const auto& [name, value] : defaults) {
    const auto row = std::find_if(table.begin(), table.end(), [&key = name](const auto& parameter) {
      return parameter.key == key;
    });
    ASSERT_NE(row, table.end()) << name;
    EXPECT_EQ(row->print(), value) << name;
    const bool is_choice = row->allowed.front() != '[';
    const std::string range =
        is_choice ? row->allowed : "[" + least.at(name) + ", " + most.at(name) + "]";
    EXPECT_EQ(row->allowed, range) << name;
  }
  for (const auto& live : LiveConfig::__getParamDescriptions__()) {
    const auto row = std::find_if(table.begin(), table.end(), [&](const auto& parameter) {
      return parameter.key == live->name;
    });
    ASSERT_NE(row, table.end()) << live->name;
    const std::string unit =
        row->unit.empty() || row->unit == "frames" ? "" : " [" + row->unit + "]";
    EXPECT_EQ(row->description,
              live->description.substr(0, live->description.size() - unit.size()) + ".");
  }
}

TEST(LiveParameters, OfMappingAreThoseOfItsTable) {
  expectTheTableSaysTheSame<occusg::MappingLiveConfig, MappingSettings>(5);
}

TEST(LiveParameters, OfTheSceneGraphAreThoseOfItsTable) {
  expectTheTableSaysTheSame<occusg::SceneGraphLiveConfig, SceneGraphSettings>(6);
}

}  // namespace
}  // namespace occusg_ros

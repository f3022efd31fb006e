// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/parameters.hpp"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

using occusg::Parameter;
using XmlRpc::XmlRpcValue;

constexpr int kMaxNesting = 8;

std::string textOf(XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return occusg::shortestText(static_cast<double>(value));
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    default:
      return {};
  }
}

void flatten(XmlRpcValue& value, const std::string& key, int depth, GivenParameters& given) {
  if (value.getType() != XmlRpcValue::TypeStruct) {
    given[key] = textOf(value);
    return;
  }
  if (depth == kMaxNesting) return;
  for (auto& entry : value)
    flatten(entry.second, key.empty() ? entry.first : key + "." + entry.first, depth + 1, given);
}

std::string withSlashes(std::string key) {
  std::replace(key.begin(), key.end(), '.', '/');
  return "~" + key;
}

bool belongsTo(const std::string& key, const std::vector<std::string>& owners) {
  return std::any_of(owners.begin(), owners.end(), [&](const std::string& owner) {
    return key.compare(0, owner.size(), owner) == 0 &&
           (key.size() == owner.size() || key[owner.size()] == '.');
  });
}

}  // namespace

Parameter textParameter(std::string& value, occusg::ParameterText text) {
  Parameter parameter{std::move(text.key),
                      std::move(text.unit),
                      "any text",
                      std::move(text.description),
                      std::move(text.paper),
                      {},
                      {},
                      {}};
  parameter.print = [&value] { return value; };
  parameter.holds = [] { return true; };
  parameter.assign = [&value](std::string_view given) {
    value = std::string(given);
    return true;
  };
  return parameter;
}

ParameterReport assign(const GivenParameters& given, const std::vector<Parameter>& parameters,
                       const std::vector<std::string>& known_elsewhere) {
  std::vector<std::string> keys;
  keys.reserve(parameters.size());
  for (const Parameter& parameter : parameters) keys.push_back(parameter.key);
  ParameterReport report;
  for (const auto& [key, text] : given) {
    const auto found = std::find(keys.begin(), keys.end(), key);
    if (found != keys.end()) {
      const Parameter& parameter = parameters[static_cast<std::size_t>(found - keys.begin())];
      if (parameter.assign(text)) continue;
      report.errors.push_back(withSlashes(key) + " is '" + text + "'; allowed is " +
                              parameter.allowed +
                              (parameter.unit.empty() ? "" : " " + parameter.unit));
    } else if (!belongsTo(key, known_elsewhere)) {
      const std::string nearest = occusg::nearestName(key, keys);
      report.warnings.push_back(withSlashes(key) + " is not a parameter; " +
                                (nearest.empty() ? "docs/ros.md lists the parameters"
                                                 : "did you mean " + withSlashes(nearest) + "?"));
    }
  }
  return report;
}

GivenParameters flattened(const XmlRpcValue& value) {
  GivenParameters given;
  XmlRpcValue copy = value;
  if (copy.getType() == XmlRpcValue::TypeStruct) flatten(copy, "", 0, given);
  return given;
}

occusg::PipelineConfig readParameters(const ros::NodeHandle& private_nh,
                                      const std::vector<Parameter>& own) {
  XmlRpcValue value;
  private_nh.getParam(private_nh.getNamespace(), value);
  occusg::PipelineConfig config;
  std::vector<Parameter> parameters = occusg::parametersOf(config);
  parameters.insert(parameters.end(), own.begin(), own.end());
  const ParameterReport report =
      assign(flattened(value), parameters, {"num_worker_threads", "diagnostic_period"});
  for (const std::string& warning : report.warnings) ROS_WARN_STREAM(warning);
  std::string errors;
  for (const std::string& error : report.errors) errors += (errors.empty() ? "" : "\n  ") + error;
  if (!errors.empty()) throw occusg::Error("these parameters cannot be used:\n  " + errors);
  check(config);
  return config;
}

}  // namespace occusg_ros

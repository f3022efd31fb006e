// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/pipeline/config.hpp"

namespace occusg_ros {

/// Values of the parameter server by dotted key, as text.
using GivenParameters = std::map<std::string, std::string>;

/// Everything wrong with the values a node was given, at once.
struct ParameterReport {
  std::vector<std::string> errors;    ///< Values that are not allowed.
  std::vector<std::string> warnings;  ///< Names nobody knows, with the nearest known one.
};

/// A parameter that takes any text.
[[nodiscard]] occusg::Parameter textParameter(std::string& value, occusg::ParameterText text);

/// Assigns what was given to the parameters of these keys.
/// @param known_elsewhere first parts of keys that belong to somebody else.
[[nodiscard]] ParameterReport assign(const GivenParameters& given,
                                     const std::vector<occusg::Parameter>& parameters,
                                     const std::vector<std::string>& known_elsewhere);

/// A value of the parameter server, nested structs flattened, scalars as text; what is neither is
/// left out.
[[nodiscard]] GivenParameters flattened(const XmlRpc::XmlRpcValue& value);

/// Reads the pipeline's parameters and the node's own from below `private_nh`, warns of names
/// nobody knows, and checks the rules between parameters.
/// @param own the node's own parameters, which live in its namespace directly.
/// @throws occusg::Error with all errors in one text.
[[nodiscard]] occusg::PipelineConfig readParameters(const ros::NodeHandle& private_nh,
                                                    const std::vector<occusg::Parameter>& own);

/// The node's own settings, whose parameters `parametersOf(Settings&)` names, and with them those
/// of the pipeline.
template <typename Settings>
[[nodiscard]] Settings readSettings(const ros::NodeHandle& private_nh,
                                    occusg::PipelineConfig& config) {
  Settings settings;
  config = readParameters(private_nh, parametersOf(settings));
  return settings;
}

}  // namespace occusg_ros

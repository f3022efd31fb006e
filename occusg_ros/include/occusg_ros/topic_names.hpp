// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace occusg_ros {

/// Messages that wait at an input of a node before the oldest is dropped.
inline constexpr std::uint32_t kInputQueue = 10;

/// The namespace of the robot whose nodes are in `node_namespace`: the one above "occusg", where
/// the launch files put the nodes; "/" for a node that is in no such namespace.
[[nodiscard]] std::string robotNamespace(const std::string& node_namespace);

/// The topic of an input: `fallback`, which can be remapped, when `given` is empty; `given` itself
/// when it begins with
/// '/'; else `given` below the robot's namespace, so that "camera/depth/image_rect" is the camera
/// of this robot.
[[nodiscard]] std::string inputTopic(const std::string& node_namespace, const std::string& given,
                                     const std::string& fallback);

}  // namespace occusg_ros

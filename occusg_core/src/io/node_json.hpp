// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "io/json_members.hpp"
#include "io/polygon_json.hpp"
#include "occusg/graph/node.hpp"

namespace occusg {

/// What a node of each type is written as in scene_graph.json, and how it is read again: all of the
/// format that depends on the type.

/// The members a node has by its type.
[[nodiscard]] nlohmann::json jsonOf(const NodeAttributes& attributes);

/// The attributes in the members of a node, whose "type" says which they are.
/// @throws Error naming the member at fault.
[[nodiscard]] NodeAttributes attributesIn(const Members& members, const Eigen::Vector3d& position,
                                          RingReader& rings);

/// Three coordinates [m].
/// @throws Error naming the member at fault.
[[nodiscard]] Eigen::Vector3d vectorOf(const Members& members, const nlohmann::json& value,
                                       const char* key);

}  // namespace occusg

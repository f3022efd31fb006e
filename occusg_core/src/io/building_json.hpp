// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// {"current_storey", "sensor_height_m", "storeys": [{"floor_z"}], "stairs": [{"kind", "storeys",
/// "risers", "path": [[x, y, z]]}]}
[[nodiscard]] nlohmann::json jsonOf(const Building& building);

/// @throws Error naming `where` and the value that cannot be.
[[nodiscard]] Building buildingIn(const nlohmann::json& value, const std::string& where);

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/scene_result.hpp"

namespace occusg {

/// Close-ups of the annotated rooms found worst, each with what became of it; worst first.
[[nodiscard]] std::string worstRooms(const BatchResults& batch);

/// A drawing of each scene under each configuration, scenes found worst first.
[[nodiscard]] std::string scenePictures(const BatchResults& batch);

}  // namespace occusg

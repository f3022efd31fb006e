// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {

/// All metrics of a scene as JSON: {"n_gt", "n_pred", "align", "shift", "@0.15": {"matches", "R",
/// "P", "F1", "mIoU", "mIoU_gt", "mIoU_full", "bF1"}, ..., "oS", "uS", "oS_rel", "uS_rel", ...,
/// "pairs": [{"pred", "gt", "iou", "bF1"}]}. An undefined value is null.
[[nodiscard]] std::string toJson(const RoomMetrics& metrics);

}  // namespace occusg

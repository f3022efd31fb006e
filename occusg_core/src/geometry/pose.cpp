// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/pose.hpp"

namespace occusg {

bool isFinite(const Pose& pose) { return pose.matrix().allFinite(); }

}  // namespace occusg

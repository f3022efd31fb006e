// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/geometry/polygon.hpp"

namespace occusg::testing {

inline Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Ring reversed(const Ring& ring) { return {ring.rbegin(), ring.rend()}; }

}  // namespace occusg::testing

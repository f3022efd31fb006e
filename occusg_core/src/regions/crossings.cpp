// SPDX-License-Identifier: BSD-3-Clause
#include "regions/crossings.hpp"

#include "regions/contacts.hpp"

namespace occusg {

std::vector<Crossing> crossingsOf(const Grid<std::int32_t>& labels, const GridFrame& frame,
                                  double min_crossing_m) {
  // Inclusive whatever the rounding of the ends' metres.
  const double limit_m = min_crossing_m - 1e-3 * frame.resolution_m;
  std::vector<Crossing> crossings;
  for (const Contact& contact : contactsOf(labels)) {
    const Segment2 segment{frame.corner(contact.from), frame.corner(contact.to)};
    if (length(segment) < limit_m) continue;
    crossings.push_back({contact.label_a, contact.label_b, segment});
  }
  return crossings;
}

}  // namespace occusg

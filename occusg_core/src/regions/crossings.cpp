// SPDX-License-Identifier: BSD-3-Clause
#include "regions/crossings.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

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

void sortByRegions(std::vector<Crossing>& crossings) {
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.region_a, a.region_b) < std::tie(b.region_a, b.region_b);
  });
}

void nameNeighbours(const std::vector<Crossing>& crossings, std::vector<Region>& regions) {
  for (Region& region : regions) region.adjacent.clear();
  for (const Crossing& crossing : crossings) {
    regions[static_cast<std::size_t>(crossing.region_a) - 1].adjacent.push_back(crossing.region_b);
    regions[static_cast<std::size_t>(crossing.region_b) - 1].adjacent.push_back(crossing.region_a);
  }
  for (Region& region : regions) {
    std::sort(region.adjacent.begin(), region.adjacent.end());
    region.adjacent.erase(std::unique(region.adjacent.begin(), region.adjacent.end()),
                          region.adjacent.end());
  }
}

}  // namespace occusg

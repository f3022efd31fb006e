// SPDX-License-Identifier: BSD-3-Clause
#include "regions/squared_distance.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace occusg {
namespace {

/// The distance [cells] of every cell to the nearest closed one of its column.
void measureColumns(const Grid<std::uint8_t>& open, std::vector<std::int32_t>& distances) {
  const auto width = static_cast<std::size_t>(open.box().width());
  const std::size_t count = distances.size();
  const std::vector<std::uint8_t>& is_open = open.values();
  for (std::size_t i = 0; i < count; ++i)
    distances[i] = is_open[i] == 0 ? 0 : 1 + (i < width ? 0 : distances[i - width]);
  for (std::size_t i = count; i-- > 0;) {
    const std::int32_t below = i + width < count ? distances[i + width] : 0;
    distances[i] = std::min(distances[i], below + 1);
  }
}

/// The lower envelope of the parabolas (x - i)^2 + height(i)^2 over a run of open cells and the
/// closed one at each end.
class Envelope {
 public:
  explicit Envelope(std::size_t width) : sites_(width + 2), starts_(width + 2) {}

  /// Replaces the column distances of a run of `length` cells by squared distances.
  void measure(std::int32_t* run, std::int64_t length) {
    build(run, length);
    for (std::int64_t x = length - 1; x >= 0; --x) {
      while (starts_[last_] > x) --last_;
      const std::int64_t site = sites_[last_].position;
      run[x] = static_cast<std::int32_t>((x - site) * (x - site) + sites_[last_].squared);
    }
  }

 private:
  struct Site {
    std::int64_t position;
    std::int64_t squared;
  };

  [[nodiscard]] static std::int64_t at(const Site& site, std::int64_t x) {
    return (x - site.position) * (x - site.position) + site.squared;
  }

  void build(const std::int32_t* run, std::int64_t length) {
    last_ = 0;
    sites_[0] = {-1, 0};
    starts_[0] = -1;
    for (std::int64_t x = 0; x <= length; ++x) {
      const std::int64_t height = x < length ? run[x] : 0;
      const Site site{x, height * height};
      while (last_ > 0 && at(sites_[last_], starts_[last_]) > at(site, starts_[last_])) --last_;
      add(site, length);
    }
  }

  void add(const Site& site, std::int64_t length) {
    const Site& before = sites_[last_];
    // The first cell that is nearer to the new site; positive numerators only, as the first site is
    // the lowest.
    const std::int64_t numerator = site.position * site.position -
                                   before.position * before.position + site.squared -
                                   before.squared;
    const std::int64_t divisor = 2 * (site.position - before.position);
    const std::int64_t start =
        1 + (numerator >= 0 ? numerator / divisor : -((-numerator + divisor - 1) / divisor));
    if (start >= length) return;
    ++last_;
    sites_[last_] = site;
    starts_[last_] = start;
  }

  std::vector<Site> sites_;
  std::vector<std::int64_t> starts_;
  std::size_t last_ = 0;
};

}  // namespace

Grid<std::int32_t> squaredDistances(const Grid<std::uint8_t>& open) {
  Grid<std::int32_t> squared(open.box(), 0);
  if (open.empty()) return squared;
  measureColumns(open, squared.values());
  const int width = open.box().width();
  Envelope envelope(static_cast<std::size_t>(width));
  // A closed cell hides what lies beyond it in its row, so each run of open cells stands alone.
  for (std::int32_t* row = squared.values().data();
       row != squared.values().data() + squared.values().size(); row += width) {
    std::int32_t* const end = row + width;
    for (std::int32_t* first = std::find_if(row, end, [](std::int32_t d) { return d != 0; });
         first != end;) {
      std::int32_t* const past = std::find(first, end, 0);
      envelope.measure(first, past - first);
      first = std::find_if(past, end, [](std::int32_t d) { return d != 0; });
    }
  }
  return squared;
}

}  // namespace occusg

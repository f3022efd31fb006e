// SPDX-License-Identifier: BSD-3-Clause
#include "regions/acceptance_guard.hpp"

namespace occusg {
namespace {

/// True when `now` is less than `before` by more than the share `max_drop`. The limit is inclusive
/// whatever the rounding of a sum of areas.
bool dropped(double now, double before, double max_drop) {
  return now < (1.0 - max_drop) * before - 1e-9 * before;
}

}  // namespace

AcceptanceGuard::AcceptanceGuard(const AcceptanceGuardConfig& config) : config_(checked(config)) {}

bool AcceptanceGuard::accept(const Decomposition& decomposition) {
  double area_m2 = 0.0;
  for (const Region& region : decomposition.regions) area_m2 += region.area_m2;
  const std::size_t count = decomposition.regions.size();
  const bool has_patience = config_.max_rejections_in_a_row == 0 ||
                            rejections_in_a_row_ < config_.max_rejections_in_a_row;
  if (losesTooMuch(area_m2, count) && has_patience) {
    ++rejections_in_a_row_;
    ++rejections_;
    return false;
  }
  accepted_area_m2_ = area_m2;
  accepted_count_ = count;
  rejections_in_a_row_ = 0;
  return true;
}

void AcceptanceGuard::reset() { *this = AcceptanceGuard(config_); }

bool AcceptanceGuard::losesTooMuch(double area_m2, std::size_t count) const {
  if (dropped(area_m2, accepted_area_m2_, config_.max_area_drop)) return true;
  return config_.reject_on_count_alone &&
         dropped(static_cast<double>(count), static_cast<double>(accepted_count_),
                 config_.max_count_drop);
}

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/stamp_gate.hpp"

#include <cmath>

namespace occusg_ros {
namespace {

// How much logical time passes at a jump.
constexpr double kAcrossJump_s = 0.1;

}  // namespace

bool isFromTheFuture(double stamp_s, double now_s) {
  constexpr double kLatest_s = 2147483647.0;
  return stamp_s > kLatest_s || (now_s > 0.0 && stamp_s > now_s + kFuture_s);
}

StampGate::Result StampGate::take(double stamp_s, double now_s) {
  if (!std::isfinite(stamp_s) || stamp_s <= 0.0) return {StampVerdict::kZero, 0.0};
  if (isFromTheFuture(stamp_s, now_s)) return {StampVerdict::kFuture, 0.0};
  if (last_logical_s_ && logical(stamp_s) < *last_logical_s_ - kJumpBack_s) {
    offset_s_ = *last_logical_s_ + kAcrossJump_s - stamp_s;
    last_logical_s_ = logical(stamp_s);
    return {StampVerdict::kJumpedBack, *last_logical_s_};
  }
  if (last_logical_s_ && logical(stamp_s) <= *last_logical_s_)
    return {StampVerdict::kNotNewer, 0.0};
  last_logical_s_ = logical(stamp_s);
  return {StampVerdict::kNewer, *last_logical_s_};
}

}  // namespace occusg_ros

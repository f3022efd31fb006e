// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace occusg_ros {

/// What a message's stamp says about it.
enum class StampVerdict {
  kNewer,       ///< Later than every stamp since the last jump.
  kNotNewer,    ///< Equal to one before it, or a little older.
  kJumpedBack,  ///< More than `kJumpBack_s` older: time started again, as when a bag loops.
  kZero,        ///< The driver sets no stamp.
  kFuture,      ///< More than `kFuture_s` ahead of the clock.
};

/// Older by more than this is a jump of the clock, not a late message [s].
inline constexpr double kJumpBack_s = 1.0;
/// Ahead of the clock by more than this is a clock that is not ours [s].
inline constexpr double kFuture_s = 5.0;

/// Whether a stamp is later than the clock by more than `kFuture_s`, or one that tf and ROS cannot
/// calculate with: their differences are 32-bit seconds, and a field that was never set may hold
/// 4294967295.
/// @param now_s the clock; zero: there is none.
[[nodiscard]] bool isFromTheFuture(double stamp_s, double now_s);

/// Turns stamps, which may jump back, into logical time, which never does: the pipeline's stages
/// take time as data that only moves on.
class StampGate {
 public:
  struct Result {
    StampVerdict verdict = StampVerdict::kZero;
    double logical_s = 0.0;  ///< Of kNewer and kJumpedBack; equals the stamp until the first jump.
  };

  /// @param now_s the clock; zero: there is none.
  Result take(double stamp_s, double now_s);

  /// Logical time of `stamp_s`, without taking it: for what happens between two messages.
  [[nodiscard]] double logical(double stamp_s) const { return stamp_s + offset_s_; }
  [[nodiscard]] std::optional<double> lastLogical() const { return last_logical_s_; }
  void reset() { *this = StampGate(); }

 private:
  std::optional<double> last_logical_s_;
  double offset_s_ = 0.0;  ///< Logical time minus stamp.
};

}  // namespace occusg_ros

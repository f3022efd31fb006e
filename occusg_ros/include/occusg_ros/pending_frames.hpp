// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace occusg_ros {

/// What happens to frames that arrive faster than they can be processed.
enum class Overload {
  kSkip,   ///< The newest usable frame goes next; older ones are dropped. The map never lags.
  kQueue,  ///< Frames wait their turn, for a replay that must use them all.
};

/// Frames that wait for their transform or for their turn, oldest first; bounded.
template <typename Frame>
class PendingFrames {
 public:
  struct Taken {
    std::optional<Frame> frame;
    std::size_t skipped = 0;  ///< Older ones given up for it.
  };

  explicit PendingFrames(std::size_t capacity) : capacity_(capacity) {}

  /// The oldest frame, when it had to make room.
  std::optional<Frame> push(Frame frame) {
    frames_.push_back(std::move(frame));
    if (frames_.size() <= capacity_) return std::nullopt;
    std::optional<Frame> pushed_out(std::move(frames_.front()));
    frames_.pop_front();
    return pushed_out;
  }

  /// The next frame among those that are ready: the newest or the oldest, as `overload` says.
  template <typename IsReady>
  Taken take(Overload overload, const IsReady& is_ready) {
    if (overload == Overload::kQueue) return takeAt(0, is_ready);
    for (std::size_t i = frames_.size(); i > 0; --i) {
      Taken taken = takeAt(i - 1, is_ready);
      if (taken.frame) return taken;
    }
    return {};
  }

  /// Removes the frames for which `is_late`; how many.
  template <typename IsLate>
  std::size_t dropLate(const IsLate& is_late) {
    std::deque<Frame> kept;
    for (Frame& frame : frames_)
      if (!is_late(frame)) kept.push_back(std::move(frame));
    const std::size_t dropped = frames_.size() - kept.size();
    frames_ = std::move(kept);
    return dropped;
  }

  void clear() { frames_.clear(); }
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }

 private:
  template <typename IsReady>
  Taken takeAt(std::size_t index, const IsReady& is_ready) {
    if (index >= frames_.size() || !is_ready(frames_[index])) return {};
    Taken taken{std::move(frames_[index]), index};
    frames_.erase(frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(index + 1));
    return taken;
  }

  std::size_t capacity_;
  std::deque<Frame> frames_;
};

}  // namespace occusg_ros

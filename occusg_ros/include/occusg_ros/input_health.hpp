// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace occusg_ros {

/// Why a message of an input was not used.
enum class Drop {
  kImage,         ///< Encoding, size or data of an image do not fit.
  kCameraInfo,    ///< There is no usable one.
  kStamp,         ///< Zero, not newer than the one before, or from the future.
  kNoTransform,   ///< tf did not know the pose in time.
  kBadTransform,  ///< What tf said is not a pose.
  kPoseJump,      ///< The pose jumped.
  kOverload,      ///< A newer one was there already.
  kMap,           ///< The map refused it, or is full.
  kPaused,        ///< Mapping is paused.
};
inline constexpr std::size_t kDropCount = 9;

/// "bad_image", "no_camera_info", ...: the keys of the diagnostics.
[[nodiscard]] std::string nameOf(Drop drop);

/// What came in and what became of it; usable from all threads.
class InputHealth {
 public:
  struct Counts {
    std::size_t received = 0;
    std::size_t used = 0;
    std::array<std::size_t, kDropCount> dropped{};
    std::string last_problem;      ///< The newest sentence; empty: none yet.
    double last_received_s = 0.0;  ///< Steady clock [s]; 0: never.
    double last_used_s = 0.0;

    [[nodiscard]] std::size_t of(Drop drop) const {
      return dropped[static_cast<std::size_t>(drop)];
    }
    [[nodiscard]] std::size_t droppedInAll() const;
  };

  void noteReceived();
  void noteUsed();
  /// @param sentence what was wrong; may be empty for reasons that speak for themselves.
  void noteDropped(Drop drop, const std::string& sentence, std::size_t count = 1);
  [[nodiscard]] Counts counts() const;

 private:
  mutable std::mutex mutex_;
  Counts counts_;
};

/// Seconds of the steady clock: for the health of the inputs, which must show also when the clock
/// of ROS stands still.
[[nodiscard]] double steadySeconds();

/// One thing a node needs before it can do anything.
struct NeededInput {
  std::string what;   ///< "depth image".
  std::string topic;  ///< Resolved name.
  std::size_t received = 0;
  std::size_t publishers = 0;
};

/// What a node that has used nothing yet lacks, in one sentence an operator can act on; empty when
/// nothing is missing.
/// @param last_problem why the messages that did come could not be used.
[[nodiscard]] std::string missingInput(const std::vector<NeededInput>& inputs,
                                       const std::string& last_problem);

/// Decides when `missingInput` is said: a few seconds after the start, again when other inputs are
/// missing than before, and every half minute while nothing could be used.
class MissingInputReport {
 public:
  /// @param running_s since the node started.
  /// @return what to say now; empty: nothing.
  [[nodiscard]] std::string toSay(const std::vector<NeededInput>& inputs,
                                  const std::string& last_problem, double running_s);

 private:
  std::string missing_;  ///< Topics without messages when it was last said.
  double said_s_ = -1.0;
};

}  // namespace occusg_ros

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace occusg_ros {

/// Writes what a node knows, one writing at a time. From time to time it does so on a thread of its
/// own, which lives as long as the saver: a slow disk must not keep the node from its work, and a
/// thread for each writing would leave the allocator a heap each.
class Saver {
 public:
  /// Writes a copy of what was known; throws when it cannot.
  using Writing = std::function<void()>;
  /// When a writing is done; one in the background may be left off when the node ends.
  enum class When { kNow, kInBackground };
  /// What became of a writing in the background: the sentence of what went wrong, empty: nothing.
  using Report = std::function<void(const std::string& problem)>;

  /// @param period_s between two writings in the background; 0: there are none.
  /// @param now_s the steady clock; the first is due one period later.
  Saver(double period_s, double now_s, Report report);
  Saver(const Saver&) = delete;
  Saver& operator=(const Saver&) = delete;
  Saver(Saver&&) = delete;
  Saver& operator=(Saver&&) = delete;
  /// Waits for the writing it is at.
  ~Saver();

  /// Whether the period has passed and nothing is being written. The member functions are called
  /// on one thread.
  [[nodiscard]] bool isDue(double now_s) const;
  void writeInBackground(double now_s, Writing writing);
  /// The node is ending and will `write` everything: a writing in the background may leave out what
  /// it has not begun.
  void hurry() { is_ending_ = true; }
  /// Whether a writing may leave out the rest.
  [[nodiscard]] bool mayLeaveOff(When when) const {
    return when == When::kInBackground && is_ending_;
  }
  /// Writes at once, after what is being written.
  void write(const Writing& writing);
  /// The last save of a node: hurries, calls `save` and logs the folder it gives, or what it
  /// throws. Only the first call does anything. Nodes call it on their worker as soon as ROS shuts
  /// down, and when they are unloaded: nodelets are unloaded one after the other, and each would
  /// wait for the save of the one before.
  void saveAtEnd(const std::string& node, const std::function<std::string()>& save);

 private:
  void loop();
  void writeAndReport(const Writing& writing);

  double period_s_;
  double last_s_;
  Report report_;
  std::mutex writing_mutex_;  ///< Held while something is written.
  std::atomic<bool> is_busy_{false};
  std::atomic<bool> is_ending_{false};
  std::mutex mutex_;  ///< Of `next_` and `stopping_`.
  std::condition_variable changed_;
  Writing next_;
  bool stopping_ = false;
  bool is_saved_at_end_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace occusg_ros

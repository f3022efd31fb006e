// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace occusg {

/// Threads that share the tasks of one call at a time. What a task does must not depend on which
/// thread takes it.
class Workers {
 public:
  /// @param threads the calling one included; 1 makes none.
  explicit Workers(int threads);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  Workers(Workers&&) = delete;
  Workers& operator=(Workers&&) = delete;
  ~Workers();

  [[nodiscard]] int threads() const { return static_cast<int>(threads_.size()) + 1; }
  /// Calls `task` with 0 .. count - 1 and returns when all are done. Tasks must not throw. Each
  /// thread begins with the same share every time, which may still be in its cache, and then helps
  /// the others. A thread that arrives when no task is left, as on a busy machine, is not waited
  /// for.
  void run(int count, const std::function<void(int)>& task);

 private:
  struct alignas(64) Share {
    std::atomic<int> next{0};
    int end = 0;
  };

  /// What `gate_` consists of: the number of the call at hand; whether threads may enter it; how
  /// many are inside, the caller not counted.
  static constexpr std::uint64_t kOpen = std::uint64_t{1} << 16;
  static constexpr std::uint64_t kRound = kOpen << 1;

  void serve(int thread);
  void awaitRound(std::uint64_t served);
  void awaitOthers();
  /// False when the call at hand is over.
  bool enter();
  void leave();
  void takeTasks(int thread);

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable started_;
  std::condition_variable finished_;
  const std::function<void(int)>* task_ = nullptr;
  std::vector<Share> shares_;  ///< One a thread.
  std::atomic<std::uint64_t> gate_{0};
  std::atomic<bool> closing_{false};
};

}  // namespace occusg

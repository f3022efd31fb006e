// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/workers.hpp"

#include <algorithm>
#include <cstddef>

namespace occusg {
namespace {

/// The steps of one frame follow each other within microseconds, and to wake a thread takes longer:
/// a thread looks so often, some 50 to 200 us, before it goes to sleep. It keeps its processor
/// meanwhile: offered to other programs, on a busy machine it comes back a time slice later.
constexpr int kLooks = 4000;

/// Leaves what the core shares to others for some cycles.
void pauseCore() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

template <typename Condition>
bool comesSoon(const Condition& condition) {
  for (int i = 0; i < kLooks; ++i) {
    if (condition()) return true;
    pauseCore();
  }
  return false;
}

}  // namespace

Workers::Workers(int threads) : shares_(static_cast<std::size_t>(std::max(threads, 1))) {
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this, i] { serve(i); });
}

Workers::~Workers() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  started_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(int count, const std::function<void(int)>& task) {
  if (threads_.empty() || count == 1) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    task_ = &task;
    for (int i = 0; i < threads(); ++i) {
      Share& share = shares_[static_cast<std::size_t>(i)];
      share.next = count * i / threads();
      share.end = count * (i + 1) / threads();
    }
    gate_ = ((gate_ / kRound + 1) * kRound) | kOpen;
  }
  started_.notify_all();
  takeTasks(0);
  gate_ &= ~kOpen;
  awaitOthers();
}

void Workers::awaitOthers() {
  const auto are_done = [this] { return gate_ % kOpen == 0; };
  if (comesSoon(are_done)) return;
  std::unique_lock<std::mutex> lock(mutex_);
  finished_.wait(lock, are_done);
}

void Workers::awaitRound(std::uint64_t served) {
  const auto is_called = [&] {
    const std::uint64_t gate = gate_;
    return closing_ || ((gate & kOpen) != 0 && gate / kRound != served);
  };
  if (comesSoon(is_called)) return;
  std::unique_lock<std::mutex> lock(mutex_);
  started_.wait(lock, is_called);
}

bool Workers::enter() {
  std::uint64_t gate = gate_;
  while ((gate & kOpen) != 0)
    if (gate_.compare_exchange_weak(gate, gate + 1)) return true;
  return false;
}

void Workers::leave() {
  const std::uint64_t gate = --gate_;
  if (gate % kOpen != 0 || (gate & kOpen) != 0) return;
  // Whoever found threads inside is asleep once the lock is free, and hears this.
  const std::lock_guard<std::mutex> lock(mutex_);
  finished_.notify_one();
}

void Workers::serve(int thread) {
  std::uint64_t served = 0;
  while (true) {
    awaitRound(served);
    if (closing_) return;
    if (!enter()) continue;
    served = gate_ / kRound;
    takeTasks(thread);
    leave();
  }
}

void Workers::takeTasks(int thread) {
  for (int i = 0; i < threads(); ++i) {
    Share& share = shares_[static_cast<std::size_t>((thread + i) % threads())];
    for (int k = share.next++; k < share.end; k = share.next++) (*task_)(k);
  }
}

}  // namespace occusg

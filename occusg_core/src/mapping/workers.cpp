// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/workers.hpp"

namespace occusg {

Workers::Workers(int threads) {
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
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
    count_ = count;
    next_ = 0;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  started_.notify_all();
  takeTasks();
  std::unique_lock<std::mutex> lock(mutex_);
  finished_.wait(lock, [this] { return busy_ == 0; });
}

void Workers::serve() {
  unsigned served = 0;
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    started_.wait(lock, [&] { return closing_ || round_ != served; });
    if (closing_) return;
    served = round_;
    lock.unlock();
    takeTasks();
    lock.lock();
    if (--busy_ == 0) finished_.notify_one();
  }
}

void Workers::takeTasks() {
  for (int i = next_++; i < count_; i = next_++) (*task_)(i);
}

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/workers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace occusg {
namespace {

class WorkersTest : public ::testing::TestWithParam<int> {};

// More threads than processors, and tasks that take next to nothing: threads come late all the
// time.
TEST_P(WorkersTest, EveryTaskOfEveryCallIsDoneOnceBeforeTheCallReturns) {
  Workers workers(GetParam());
  EXPECT_EQ(workers.threads(), GetParam());
  std::vector<int> done(23, 0);
  for (int call = 1; call <= 5000; ++call) {
    const int count = 1 + call % static_cast<int>(done.size());
    std::fill(done.begin(), done.end(), 0);
    workers.run(count, [&](int task) { ++done[static_cast<std::size_t>(task)]; });
    for (int task = 0; task < static_cast<int>(done.size()); ++task)
      ASSERT_EQ(done[static_cast<std::size_t>(task)], task < count ? 1 : 0) << "call " << call;
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkersTest, ::testing::Values(1, 2, 3, 8));

TEST(Workers, ThreadsHelpACallerThatIsBusyWithATask) {
  Workers workers(2);
  std::atomic<int> others{0};
  // The caller's task ends when somebody else has done one: alone it would never end.
  const std::thread::id caller = std::this_thread::get_id();
  workers.run(8, [&](int /*task*/) {
    if (std::this_thread::get_id() != caller) {
      ++others;
    } else {
      while (others == 0) std::this_thread::yield();
    }
  });
  EXPECT_GE(others, 1);
}

TEST(Workers, NoTasksAreDoneAtOnce) {
  Workers workers(3);
  workers.run(0, [](int /*task*/) { FAIL(); });
}

}  // namespace
}  // namespace occusg

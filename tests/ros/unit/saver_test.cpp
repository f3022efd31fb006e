// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saver.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "occusg_ros/chunked_buffer.hpp"

namespace occusg_ros {
namespace {

TEST(Saver, FailureMode15NextIsDueOnePeriodLater) {
  Saver saver(30.0, 100.0, [](const std::string&) {});
  EXPECT_FALSE(saver.isDue(129.0));
  EXPECT_TRUE(saver.isDue(130.0));
  saver.write([] {});
  EXPECT_TRUE(saver.isDue(130.0)) << "what was asked for elsewhere changes nothing";
}

TEST(Saver, FailureMode15PeriodOfZeroIsNever) {
  const Saver saver(0.0, 0.0, [](const std::string&) {});
  EXPECT_FALSE(saver.isDue(1e9));
}

TEST(Saver, FailureMode15SlowDiskKeepsNobodyWaitingAndNothingPilesUp) {
  std::promise<void> disk;
  std::promise<std::string> reported;
  Saver saver(1.0, 0.0, [&](const std::string& problem) { reported.set_value(problem); });
  saver.writeInBackground(10.0, [written = disk.get_future().share()] { written.wait(); });
  EXPECT_FALSE(saver.isDue(20.0)) << "the first is still being written";
  disk.set_value();
  EXPECT_EQ(reported.get_future().get(), "");
}

TEST(Saver, FailureMode15OnlyAWritingInTheBackgroundIsLeftOffAtTheEnd) {
  Saver saver(1.0, 0.0, [](const std::string&) {});
  EXPECT_FALSE(saver.mayLeaveOff(Saver::When::kInBackground));
  saver.hurry();
  EXPECT_TRUE(saver.mayLeaveOff(Saver::When::kInBackground));
  EXPECT_FALSE(saver.mayLeaveOff(Saver::When::kNow));
}

TEST(Saver, FailureMode20AllIsWrittenOnOneThread) {
  std::set<std::thread::id> threads;
  Saver saver(1.0, 0.0, [](const std::string&) {});
  for (int i = 1; i <= 20; ++i) {
    std::promise<void> written;
    saver.writeInBackground(10.0 * i, [&] {
      threads.insert(std::this_thread::get_id());
      written.set_value();
    });
    written.get_future().wait();
    while (!saver.isDue(10.0 * i + 5.0)) std::this_thread::yield();
  }
  EXPECT_EQ(threads.size(), 1U);
}

TEST(ChunkedBuffer, GivesBackWhatWasWrittenWhateverItsLength) {
  for (const std::size_t length : {0U, 1U, 262'144U, 1'000'000U}) {
    std::string bytes(length, '\0');
    for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<char>(i * 31U);
    ChunkedBuffer buffer;
    std::ostream stream(&buffer);
    stream.put('a');
    stream << bytes;
    stream.write(bytes.data(), static_cast<std::streamsize>(length));
    std::ostringstream copy;
    buffer.writeTo(copy);
    EXPECT_EQ(copy.str(), "a" + bytes + bytes);
    EXPECT_EQ(buffer.size(), copy.str().size());
  }
}

TEST(Saver, FailureMode16WhatGoesWrongIsReported) {
  std::vector<std::string> problems;
  {
    Saver saver(1.0, 0.0, [&](const std::string& problem) { problems.push_back(problem); });
    saver.writeInBackground(10.0, [] { throw std::runtime_error("the disk is full"); });
  }
  EXPECT_EQ(problems, std::vector<std::string>{"the disk is full"});
}

TEST(Saver, FailureMode20EndWaitsForWhatIsBeingWritten) {
  std::atomic<bool> written{false};
  {
    Saver saver(1.0, 0.0, [](const std::string&) {});
    std::promise<void> begun;
    saver.writeInBackground(10.0, [&] {
      begun.set_value();
      written = true;
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(written);
}

}  // namespace
}  // namespace occusg_ros

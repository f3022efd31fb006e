// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <mutex>
#include <new>
#include <stdexcept>
#include <vector>

#include "occusg_ros/pending_frames.hpp"
#include "occusg_ros/pose_gate.hpp"
#include "occusg_ros/ros_timeline.hpp"
#include "occusg_ros/stamp_gate.hpp"
#include "occusg_ros/tf_input.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "occusg_ros/worker.hpp"

namespace occusg_ros {
namespace {

occusg::Pose at(double x, double yaw_rad = 0.0) {
  occusg::Pose pose = occusg::Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.translation().x() = x;
  return pose;
}

TEST(StampGate, FailureMode06EqualAndOlderStampsAreNotNewer) {
  StampGate gate;
  EXPECT_EQ(gate.take(10.0, 0.0).verdict, StampVerdict::kNewer);
  EXPECT_EQ(gate.take(10.0, 0.0).verdict, StampVerdict::kNotNewer);
  EXPECT_EQ(gate.take(9.5, 0.0).verdict, StampVerdict::kNotNewer);
  EXPECT_EQ(gate.take(10.1, 0.0).verdict, StampVerdict::kNewer);
}

TEST(StampGate, FailureMode06StampZeroAndFarFutureAreRefused) {
  StampGate gate;
  EXPECT_EQ(gate.take(0.0, 100.0).verdict, StampVerdict::kZero);
  EXPECT_EQ(gate.take(std::numeric_limits<double>::quiet_NaN(), 0.0).verdict, StampVerdict::kZero);
  EXPECT_EQ(gate.take(106.0, 100.0).verdict, StampVerdict::kFuture);
  EXPECT_EQ(gate.take(101.0, 100.0).verdict, StampVerdict::kNewer);
}

TEST(StampGate, FailureMode06LogicalTimeGoesOnWhenTheClockJumpsBack) {
  StampGate gate;
  EXPECT_DOUBLE_EQ(gate.take(1000.0, 0.0).logical_s, 1000.0);
  EXPECT_DOUBLE_EQ(gate.take(1060.0, 0.0).logical_s, 1060.0);
  const StampGate::Result jump = gate.take(1000.0, 0.0);
  EXPECT_EQ(jump.verdict, StampVerdict::kJumpedBack);
  EXPECT_GT(jump.logical_s, 1060.0);
  const StampGate::Result next = gate.take(1000.2, 0.0);
  EXPECT_EQ(next.verdict, StampVerdict::kNewer);
  EXPECT_NEAR(next.logical_s - jump.logical_s, 0.2, 1e-9);
}

TEST(RosTimeline, NeverGoesBackWhateverTheClockDoes) {
  RosTimeline timeline;
  EXPECT_DOUBLE_EQ(timeline.now(50.0), 50.0);
  EXPECT_DOUBLE_EQ(timeline.at(49.8), 50.0) << "a message is a little late";
  EXPECT_DOUBLE_EQ(timeline.at(1.0), 50.0) << "a finished map is older than the node";
  EXPECT_DOUBLE_EQ(timeline.now(51.0), 51.0);
  EXPECT_DOUBLE_EQ(timeline.now(10.0), 51.0) << "the bag begins again";
  EXPECT_DOUBLE_EQ(timeline.now(12.0), 53.0);
  EXPECT_DOUBLE_EQ(timeline.at(12.5), 53.5);
}

TEST(RosTimeline, GoesOnAfterASessionThatWasSavedUnderAnotherClock) {
  RosTimeline timeline;
  timeline.goOnAfter(1060.0, 1000.0);
  EXPECT_DOUBLE_EQ(timeline.now(1001.0), 1061.0);
  RosTimeline later;
  later.goOnAfter(1060.0, 5000.0);
  EXPECT_DOUBLE_EQ(later.now(5001.0), 5001.0);
}

TEST(PoseGate, FailureMode05JumpIsHeldBackAndARelocalisationGoesThrough) {
  PoseGate gate({1.0, 0.79, 1.0, 3});
  EXPECT_EQ(gate.take(at(0.0), 0.0), PoseVerdict::kUsual);
  EXPECT_EQ(gate.take(at(0.5), 0.1), PoseVerdict::kUsual);
  EXPECT_EQ(gate.take(at(9.0), 0.2), PoseVerdict::kJump) << "a glitch";
  EXPECT_EQ(gate.take(at(0.6), 0.3), PoseVerdict::kUsual);
  EXPECT_EQ(gate.take(at(9.0), 0.4), PoseVerdict::kJump);
  EXPECT_EQ(gate.take(at(9.1), 0.5), PoseVerdict::kJump);
  EXPECT_EQ(gate.take(at(9.2), 0.6), PoseVerdict::kRelocalised);
  EXPECT_EQ(gate.take(at(9.3), 0.7), PoseVerdict::kUsual);
}

TEST(PoseGate, FailureMode05ScatteredJumpsNeverBecomeARelocalisation) {
  PoseGate gate({1.0, 0.79, 1.0, 3});
  EXPECT_EQ(gate.take(at(0.0), 0.0), PoseVerdict::kUsual);
  for (int i = 1; i < 9; ++i) EXPECT_EQ(gate.take(at(10.0 * i), 0.1 * i), PoseVerdict::kJump) << i;
}

TEST(PoseGate, FailureMode05TurnsCountAndLongPausesDoNot) {
  PoseGate gate({1.0, 0.79, 1.0, 3});
  EXPECT_EQ(gate.take(at(0.0), 0.0), PoseVerdict::kUsual);
  EXPECT_EQ(gate.take(at(0.0, 1.0), 0.1), PoseVerdict::kJump);
  EXPECT_EQ(gate.take(at(0.0, 0.7), 0.2), PoseVerdict::kUsual);
  EXPECT_EQ(gate.take(at(30.0), 5.0), PoseVerdict::kUsual);
}

TEST(PendingFrames, FailureMode08NewestReadyFrameGoesFirstAndOlderOnesAreSkipped) {
  PendingFrames<int> frames(10);
  for (int i = 1; i <= 5; ++i) EXPECT_FALSE(frames.push(i));
  const auto taken = frames.take(Overload::kSkip, [](int frame) { return frame <= 3; });
  ASSERT_TRUE(taken.frame);
  EXPECT_EQ(*taken.frame, 3);
  EXPECT_EQ(taken.skipped, 2U);
  EXPECT_EQ(frames.size(), 2U) << "4 and 5 still wait for their transforms";
  EXPECT_FALSE(frames.take(Overload::kSkip, [](int) { return false; }).frame);
}

TEST(PendingFrames, FailureMode08MemoryIsBoundedByTheOldestGoing) {
  PendingFrames<int> frames(2);
  EXPECT_FALSE(frames.push(1) || frames.push(2));
  EXPECT_EQ(frames.push(3), 1) << "the oldest";
  EXPECT_EQ(*frames.take(Overload::kQueue, [](int) { return true; }).frame, 2);
}

TEST(PendingFrames, QueueKeepsTheOrderAndWaitsForItsFirst) {
  PendingFrames<int> frames(10);
  (void)frames.push(1);
  (void)frames.push(2);
  EXPECT_FALSE(frames.take(Overload::kQueue, [](int frame) { return frame == 2; }).frame);
  EXPECT_EQ(*frames.take(Overload::kQueue, [](int) { return true; }).frame, 1);
  EXPECT_EQ(frames.dropLate([](int frame) { return frame == 2; }), 1U);
  EXPECT_TRUE(frames.empty());
}

TEST(Worker, RunsTasksInOrderAndStepsBetweenThem) {
  std::promise<void> stepped;
  std::atomic<bool> once{false};
  Worker worker(
      std::chrono::milliseconds(1),
      [&] {
        if (!once.exchange(true)) stepped.set_value();
        return Worker::Progress::kIdle;
      },
      [](const Failure&) {});
  std::vector<int> order;
  worker.post([&] { order.push_back(1); });
  EXPECT_TRUE(worker.run([&] { order.push_back(2); }, std::chrono::seconds(10)));
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
  EXPECT_EQ(stepped.get_future().wait_for(std::chrono::seconds(10)), std::future_status::ready);
}

TEST(Worker, FailureMode20EndsWithTasksStillWaiting) {
  std::atomic<int> ran{0};
  {
    Worker worker(
        std::chrono::milliseconds(1), [] { return Worker::Progress::kIdle; },
        [](const Failure&) {});
    std::promise<void> begun;
    std::promise<void> go_on;
    worker.post([&] {
      begun.set_value();
      go_on.get_future().wait();
      ++ran;
    });
    begun.get_future().wait();
    for (int i = 0; i < 100; ++i) worker.post([&] { ++ran; });
    EXPECT_FALSE(worker.run([] {}, std::chrono::milliseconds(1))) << "it is busy";
    go_on.set_value();
  }
  EXPECT_GE(ran, 1);
}

TEST(Worker, FailureMode10WhatATaskOrAStepThrowsIsReportedAndTheWorkerGoesOn) {
  std::mutex mutex;
  std::vector<Failure> failures;
  std::atomic<bool> step_throws{true};
  Worker worker(
      std::chrono::milliseconds(1),
      [&]() -> Worker::Progress {
        if (step_throws.exchange(false)) throw std::bad_alloc();
        return Worker::Progress::kIdle;
      },
      [&](const Failure& failure) {
        const std::lock_guard<std::mutex> lock(mutex);
        failures.push_back(failure);
      });
  worker.post([] { throw std::runtime_error("Duration is out of dual 32-bit range"); });
  worker.post([] { throw 7; });
  int ran = 0;
  while (step_throws) ASSERT_TRUE(worker.run([&] { ++ran; }, std::chrono::seconds(10)));
  ASSERT_TRUE(worker.run([&] { ++ran; }, std::chrono::seconds(10)));
  EXPECT_GE(ran, 1);
  const std::lock_guard<std::mutex> lock(mutex);
  ASSERT_EQ(failures.size(), 3U);
  const auto out_of_memory =
      std::count_if(failures.begin(), failures.end(),
                    [](const Failure& failure) { return failure.is_out_of_memory; });
  EXPECT_EQ(out_of_memory, 1);
  for (const Failure& failure : failures) EXPECT_FALSE(failure.problem.empty());
}

TEST(StampGate, FailureMode06StampThatWasNeverSetIsRefusedWithoutAClockToo) {
  EXPECT_TRUE(isFromTheFuture(4294967295.0, 0.0));
  EXPECT_TRUE(isFromTheFuture(106.0, 100.0));
  EXPECT_FALSE(isFromTheFuture(104.0, 100.0));
  EXPECT_FALSE(isFromTheFuture(104.0, 0.0));
  StampGate gate;
  EXPECT_EQ(gate.take(4294967295.0, 0.0).verdict, StampVerdict::kFuture);
  EXPECT_EQ(gate.take(10.0, 0.0).verdict, StampVerdict::kNewer);
}

TEST(RosTimeline, FailureMode06OneStampFromTheFutureDoesNotStopTime) {
  RosTimeline timeline;
  EXPECT_DOUBLE_EQ(timeline.now(100.0), 100.0);
  EXPECT_LE(timeline.at(4294967295.0), 105.0);
  EXPECT_DOUBLE_EQ(timeline.now(110.0), 110.0);
}

TEST(TfInput, FailureMode04TransformsThatCannotBeAreNamed) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(100.0);
  transform.header.frame_id = "map";
  transform.child_frame_id = "base_link";
  transform.transform.rotation.w = 1.0;
  const ros::Time now(100.0);
  EXPECT_EQ(transformProblem(transform, now), "");
  auto future = transform;
  future.header.stamp = ros::Time(4294967295U, 0);
  EXPECT_NE(transformProblem(future, now).find("future"), std::string::npos);
  EXPECT_NE(transformProblem(future, ros::Time()).find("future"), std::string::npos);
  auto nowhere = transform;
  nowhere.transform.translation.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(transformProblem(nowhere, now).find("not finite"), std::string::npos);
  auto no_rotation = transform;
  no_rotation.transform.rotation.w = 0.0;
  EXPECT_NE(transformProblem(no_rotation, now).find("quaternion"), std::string::npos);
  auto nameless = transform;
  nameless.child_frame_id.clear();
  EXPECT_NE(transformProblem(nameless, now).find("no name"), std::string::npos);
}

TEST(PoseAt, SlashBeforeTheNameOfAFrameIsNoPartOfIt) {
  tf2::BufferCore tf;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(100.0);
  transform.header.frame_id = "/world";
  transform.child_frame_id = "/openni_rgb_optical_frame";
  transform.transform.rotation.w = 1.0;
  tf.setTransform(transform, "test");
  EXPECT_EQ(poseAt(tf, "world", "/openni_rgb_optical_frame", ros::Time(100.0)).kind,
            PoseAnswer::Kind::kFound);
  EXPECT_EQ(poseAt(tf, "/world", "openni_rgb_optical_frame", ros::Time(100.0)).kind,
            PoseAnswer::Kind::kFound);
}

TEST(PoseAt, FailureMode06StampBeyondWhatTfCalculatesWithIsAnAnswer) {
  tf2::BufferCore tf;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(100.0);
  transform.header.frame_id = "map";
  transform.child_frame_id = "base_link";
  transform.transform.rotation.w = 1.0;
  tf.setTransform(transform, "test");
  transform.header.stamp = ros::Time(4294967295U, 0);
  EXPECT_NE(poseAt(tf, "map", "base_link", transform.header.stamp).kind, PoseAnswer::Kind::kFound);
}

}  // namespace
}  // namespace occusg_ros

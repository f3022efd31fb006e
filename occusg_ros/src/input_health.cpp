// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/input_health.hpp"

#include <chrono>
#include <numeric>

#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

constexpr double kSayMissingAfter_s = 4.0;  // said within 5 s, checked every second
constexpr double kSayAgainAfter_s = 30.0;

}  // namespace

std::string nameOf(Drop drop) {
  switch (drop) {
    case Drop::kImage:
      return "bad_image";
    case Drop::kCameraInfo:
      return "no_camera_info";
    case Drop::kStamp:
      return "bad_stamp";
    case Drop::kNoTransform:
      return "no_transform";
    case Drop::kBadTransform:
      return "bad_transform";
    case Drop::kPoseJump:
      return "pose_jump";
    case Drop::kOverload:
      return "overload";
    case Drop::kMap:
      return "refused_by_map";
    case Drop::kPaused:
      return "paused";
  }
  return "unknown";
}

std::size_t InputHealth::Counts::droppedInAll() const {
  return std::accumulate(dropped.begin(), dropped.end(), std::size_t{0});
}

void InputHealth::noteReceived() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.received;
  counts_.last_received_s = steadySeconds();
}

void InputHealth::noteUsed() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++counts_.used;
  counts_.last_used_s = steadySeconds();
}

void InputHealth::noteDropped(Drop drop, const std::string& sentence, std::size_t count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  counts_.dropped[static_cast<std::size_t>(drop)] += count;
  if (!sentence.empty()) counts_.last_problem = shownText(sentence);
}

InputHealth::Counts InputHealth::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

double steadySeconds() {
  const std::chrono::duration<double> since_start =
      std::chrono::steady_clock::now().time_since_epoch();
  return since_start.count();
}

std::string missingInput(const std::vector<NeededInput>& inputs, const std::string& last_problem) {
  std::string missing;
  for (const NeededInput& input : inputs) {
    if (input.received > 0) continue;
    missing += missing.empty() ? "no " : ", and no ";
    missing += input.what + " on " + input.topic;
    missing += input.publishers == 0
                   ? " (nobody publishes it; remap it or start the driver)"
                   : " (" + std::to_string(input.publishers) + " publisher, but no message yet)";
  }
  if (!missing.empty()) return missing;
  return last_problem.empty() ? "" : "messages come but none could be used: " + last_problem;
}

std::string MissingInputReport::toSay(const std::vector<NeededInput>& inputs,
                                      const std::string& last_problem, double running_s) {
  if (running_s < kSayMissingAfter_s) return {};
  std::string sentence = missingInput(inputs, last_problem);
  if (sentence.empty()) return {};
  std::string missing;
  for (const NeededInput& input : inputs)
    if (input.received == 0) missing += input.topic + " ";
  const bool is_news = said_s_ < 0.0 || missing != missing_;
  if (!is_news && running_s - said_s_ < kSayAgainAfter_s) return {};
  missing_ = missing;
  said_s_ = running_s;
  return sentence;
}

}  // namespace occusg_ros

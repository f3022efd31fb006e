// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/what_is_there.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "occusg_ros/shown_text.hpp"

namespace occusg_ros {
namespace {

constexpr std::size_t kMostShown = 4;

std::set<std::string> wordsOf(std::string topic) {
  std::replace_if(
      topic.begin(), topic.end(), [](char c) { return c == '/' || c == '_'; }, ' ');
  std::istringstream stream(topic);
  std::set<std::string> words;
  for (std::string word; stream >> word;) words.insert(word);
  return words;
}

std::size_t commonWords(const std::set<std::string>& a, const std::string& topic) {
  const std::set<std::string> b = wordsOf(topic);
  return static_cast<std::size_t>(std::count_if(
      a.begin(), a.end(), [&](const std::string& word) { return b.count(word) > 0; }));
}

}  // namespace

std::string publishedInstead(const std::string& wanted, const std::string& type,
                             const ros::master::V_TopicInfo& topics) {
  const std::set<std::string> words = wordsOf(wanted);
  std::vector<std::pair<std::size_t, std::string>> candidates;
  for (const ros::master::TopicInfo& topic : topics) {
    const bool is_below = topic.name.rfind(wanted + "/", 0) == 0;
    if (topic.name == wanted || (!is_below && topic.datatype != type)) continue;
    candidates.emplace_back(commonWords(words, topic.name) + (is_below ? words.size() : 0),
                            topic.name);
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  if (candidates.empty()) return "";
  std::string text;
  const std::size_t shown = std::min(kMostShown, candidates.size());
  for (std::size_t i = 0; i < shown; ++i)
    text += (i == 0 ? "; " : ", ") + shownName(candidates[i].second);
  return text + (shown == 1 ? " is published" : " are published");
}

std::string publishedInstead(const std::string& wanted, const std::string& type) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return "";
  return publishedInstead(wanted, type, topics);
}

std::string framesInstead(const tf2::BufferCore& tf) {
  constexpr std::size_t kMostFrames = 8;
  std::vector<std::string> frames;
  tf._getFrameStrings(frames);
  if (frames.empty()) return "; tf has no frames";
  std::string text = "; tf has ";
  for (std::size_t i = 0; i < std::min(kMostFrames, frames.size()); ++i)
    text += (i == 0 ? "" : ", ") + shownName(frames[i]);
  return text + (frames.size() > kMostFrames ? ", ..." : "");
}

}  // namespace occusg_ros

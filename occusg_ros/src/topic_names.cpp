// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/topic_names.hpp"

namespace occusg_ros {

std::string robotNamespace(const std::string& node_namespace) {
  const std::string own = "/occusg";
  if (node_namespace.size() <= own.size()) return "/";
  const std::size_t above = node_namespace.size() - own.size();
  return node_namespace.compare(above, own.size(), own) == 0 ? node_namespace.substr(0, above)
                                                             : "/";
}

std::string inputTopic(const std::string& node_namespace, const std::string& given,
                       const std::string& fallback) {
  if (given.empty()) return fallback;
  if (given.front() == '/') return given;
  const std::string robot = robotNamespace(node_namespace);
  return (robot == "/" ? "" : robot) + "/" + given;
}

}  // namespace occusg_ros

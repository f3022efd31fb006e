// SPDX-License-Identifier: BSD-3-Clause
#include "version.hpp"

namespace occusg::apps {

/// Defined in a file that the build writes (cmake/OccusgCommit.cmake).
extern const char* const kCommit;

std::string versionText() {
  std::string text = "occusg " OCCUSG_VERSION;
  const std::string commit = kCommit;
  if (!commit.empty()) text += ", commit " + commit;
#ifdef NDEBUG
  return text + ", Release build";
#else
  return text + ", Debug build";
#endif
}

}  // namespace occusg::apps

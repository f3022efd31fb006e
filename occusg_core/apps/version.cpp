// SPDX-License-Identifier: BSD-3-Clause
#include "version.hpp"

#include "occusg_commit.hpp"

namespace occusg::apps {

std::string versionText() {
  std::string text = "occusg " OCCUSG_VERSION;
  const std::string commit = OCCUSG_COMMIT;
  if (!commit.empty()) text += ", commit " + commit;
#ifdef NDEBUG
  return text + ", Release build";
#else
  return text + ", Debug build";
#endif
}

}  // namespace occusg::apps

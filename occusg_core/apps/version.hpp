// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg::apps {

/// "occusg 0.2.0, commit 79a4bc1, Release build"; without the commit when the sources were no git
/// clone. "-dirty" behind the commit: files differed from it.
[[nodiscard]] std::string versionText();

}  // namespace occusg::apps

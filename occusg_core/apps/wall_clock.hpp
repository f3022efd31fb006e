// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace occusg::apps {

/// Stamps after it are from the future: the clock's time and 5 s for clocks that differ [s].
[[nodiscard]] double latestCredibleStamp();

}  // namespace occusg::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

namespace occusg_ros {

/// Keeps numbers that are none out of the parameters that change live: dynamic_reconfigure holds
/// values within their range by comparing them, which NaN survives.
class LiveValues {
 public:
  /// `offered`, or what is in use when that is not finite; `offered` becomes what is returned, so
  /// that whoever asked sees it.
  double finite(const char* name, double& offered, double in_use) {
    if (!std::isfinite(offered)) {
      refused_ += (refused_.empty() ? "" : ", ") + std::string(name);
      offered = in_use;
    }
    return offered;
  }

  /// Names of the parameters that were refused; empty when none was.
  [[nodiscard]] const std::string& refused() const { return refused_; }

 private:
  std::string refused_;
};

}  // namespace occusg_ros

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg {

/// What makes two class names one: lower case, spaces around them dropped, spaces and hyphens
/// within as "_".
[[nodiscard]] std::string classKey(const std::string& class_name);

}  // namespace occusg

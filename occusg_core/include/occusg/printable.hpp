// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg {

/// Whether the text is UTF-8 (RFC 3629) of characters that can be shown in a line: no control
/// characters, no line or paragraph separators, none that turn the direction of writing.
[[nodiscard]] bool isPrintableUtf8(const std::string& text);

}  // namespace occusg

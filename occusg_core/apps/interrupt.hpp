// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace occusg::apps {

/// From here on Ctrl-C and a polite kill do not end the process but are remembered. A second one
/// ends it at once.
void catchInterrupts();

[[nodiscard]] bool interrupted();

}  // namespace occusg::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace occusg::apps {

/// Refuses to write what is being read: the map, the rooms or the house would be gone.
/// @throws Error naming the file when `written` is one of `inputs`, under whatever name.
void checkNotAnInput(const std::string& written, const std::vector<std::string>& inputs);

/// The same for files of the names in `folder`.
void checkNotInputs(const std::string& folder, const std::vector<std::string>& names,
                    const std::vector<std::string>& inputs);

/// Whether a session can be saved there beside results in `output`: a session's folder is replaced
/// as a whole, with whatever lies in it.
/// @throws Error naming the folder that is in the way or cannot be written.
void checkSessionCanBeSaved(const std::string& session, const std::string& output);

}  // namespace occusg::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/graph/graph_config.hpp"

namespace occusg {

/// The table as `config/room_labels.yaml` holds it: a line "label:" for each kind of room, and
/// below it, indented, a line "class: weight" for each object class that speaks for it.
[[nodiscard]] std::string toYaml(const RoomLabelTable& table);

/// Reads such a table. Classes are taken by their `classKey`.
/// @param where name of the document for messages, usually its path.
/// @throws Error naming the line: what is no such line, a label or class given twice, a weight
/// outside (0, 100], more than 1000 labels or classes of a label, names longer than 200 bytes.
[[nodiscard]] RoomLabelTable roomLabelsFromYaml(const std::string& yaml, const std::string& where);

/// @throws Error as `roomLabelsFromYaml`, or when the file cannot be read or exceeds 1 MiB.
[[nodiscard]] RoomLabelTable readRoomLabels(const std::string& path);

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// Reads the rooms another program predicted: as `readRooms`, but where a room has no integer id
/// ("R(0)", or none) all rooms are numbered from 1 in the order of the file, and doors, which could
/// then not be told apart, are left out.
/// @throws Error as `readRooms`.
[[nodiscard]] RoomsFile readExternalRooms(const std::string& path,
                                          RingOrder order = RingOrder::kOriented);

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/io/rooms_file.hpp"
#include "occusg/pipeline/stage_times.hpp"

namespace occusg::apps {

/// Writes a line a room: id, label, area, and the rooms it is joined to.
void printRooms(const RoomsFile& rooms);

/// Writes a line a stage: how often it ran, how long it took, what it holds.
void printTimes(const StageTimes& times);

/// Books the peak memory of the process under 'total'.
void setPeakMemory(StageTimes& times);

}  // namespace occusg::apps

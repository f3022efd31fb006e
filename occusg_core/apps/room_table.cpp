// SPDX-License-Identifier: BSD-3-Clause
#include "room_table.hpp"

#include <sys/resource.h>

#include <iomanip>
#include <iostream>
#include <set>

#include "io/json_text.hpp"

namespace occusg::apps {

void printRooms(const RoomsFile& rooms) {
  std::cout << "\n  room  label             area m2  joined to\n";
  for (const RoomRecord& room : rooms.rooms) {
    std::set<int> joined;
    for (const DoorRecord& door : rooms.doors) {
      if (door.room_a == room.id) joined.insert(door.room_b);
      if (door.room_b == room.id) joined.insert(door.room_a);
    }
    // Rounded as in scene_graph.json, so that 'occusg show' prints the same.
    std::cout << std::setw(6) << room.id << "  " << std::left << std::setw(16) << room.label
              << std::right << std::setw(9) << std::fixed << std::setprecision(2)
              << occusg::rounded(area(room.polygon)) << "  ";
    for (const int other : joined) std::cout << other << ' ';
    std::cout << '\n';
  }
}

void printTimes(const StageTimes& times) {
  std::cout << "\n  stage           count   mean ms    p50 ms    p95 ms    max ms  memory MiB\n";
  for (const Stage stage : kStages) {
    const StageSummary summary = times.summary(stage);
    std::cout << "  " << std::left << std::setw(14) << nameOf(stage) << std::right << std::setw(7)
              << summary.count << std::fixed << std::setprecision(2) << std::setw(10)
              << summary.mean_ms << std::setw(10) << summary.p50_ms << std::setw(10)
              << summary.p95_ms << std::setw(10) << summary.max_ms << std::setw(12)
              << static_cast<double>(times.memoryBytes(stage)) / (1024.0 * 1024.0) << '\n';
  }
  std::cout << "  (memory of 'total' is the peak of the whole process)\n";
#ifndef NDEBUG
  std::cout << "  (this is a Debug build: a Release build is several times faster)\n";
#endif
}

void setPeakMemory(StageTimes& times) {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0)
    times.setMemory(Stage::kTotal, static_cast<std::size_t>(usage.ru_maxrss) * 1024U);
}

}  // namespace occusg::apps

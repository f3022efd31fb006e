// SPDX-License-Identifier: BSD-3-Clause
// Takes a recording through the whole pipeline and prints its rooms.
// Usage: 01_run_recording RECORDING          for example examples/apartment
#include <iostream>

#include "occusg/occusg.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 01_run_recording RECORDING\n";
    return 2;
  }
  try {
    const occusg::SequenceReader recording(argv[1]);
    occusg::Pipeline pipeline(occusg::loadConfig("default"));
    for (std::size_t i = 0; i < recording.size(); ++i) {
      const occusg::FrameReport report = pipeline.process(recording.read(i));
      if (!report.isUsed())
        std::cerr << "frame " << i << ": " << occusg::sentenceOn(report.verdict) << '\n';
    }
    pipeline.finish();
    for (const auto& [id, node] : pipeline.graph().nodes(occusg::NodeType::kRoom)) {
      const occusg::RoomAttributes& room = pipeline.graph().room(id);
      std::cout << room.name << ": " << occusg::area(room.polygon) << " m2\n";
    }
  } catch (const occusg::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// A decomposer of your own, outside of OccuSG: squares of five metres.
// Usage: 04_own_decomposer RECORDING          for example examples/apartment
#include <cmath>
#include <iostream>
#include <memory>

#include "occusg/occusg.hpp"

namespace {

/// Cuts free space along the lines of a grid.
class SquareDecomposer : public occusg::Decomposer {
 public:
  explicit SquareDecomposer(double side_m) : side_m_(side_m) {}

  using occusg::Decomposer::update;
  const occusg::Decomposition& update(const occusg::FreeSpace& layer,
                                      const occusg::CellBox& /*changed*/) override {
    occusg::Grid<std::int32_t> labels(layer.cells.box(), occusg::kNoRegion);
    constexpr int kColumns = 10'000;
    for (int y = labels.box().min.y; y < labels.box().max.y; ++y) {
      for (int x = labels.box().min.x; x < labels.box().max.x; ++x) {
        const occusg::Cell cell{x, y};
        if (layer.cells.at(cell) != occusg::kFree) continue;
        const occusg::Point2 at = layer.frame.center(cell);
        const int column = static_cast<int>(std::floor(at.x / side_m_));
        const int row = static_cast<int>(std::floor(at.y / side_m_));
        labels.at(cell) = 1 + (row + kColumns / 2) * kColumns + column + kColumns / 2;
      }
    }
    decomposition_ = occusg::decompositionOf(occusg::numberedPieces(labels), layer.frame);
    return decomposition_;
  }

  void reset() override {}

 private:
  double side_m_;
  occusg::Decomposition decomposition_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 04_own_decomposer RECORDING\n";
    return 2;
  }
  try {
    const occusg::SequenceReader recording(argv[1]);
    occusg::Pipeline pipeline(occusg::loadConfig("default"),
                              std::make_unique<SquareDecomposer>(5.0));
    for (std::size_t i = 0; i < recording.size(); ++i) (void)pipeline.process(recording.read(i));
    pipeline.finish();
    std::cout << pipeline.regions().decomposition.regions.size() << " regions of at most 25 m2, "
              << pipeline.graph().nodes(occusg::NodeType::kRoom).size() << " rooms\n";
  } catch (const occusg::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

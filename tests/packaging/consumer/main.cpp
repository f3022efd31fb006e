// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "occusg/geometry/polygon_overlap.hpp"
#include "occusg/pipeline/pipeline.hpp"

int main() {
  const occusg::Pipeline pipeline{occusg::PipelineConfig{}};
  const occusg::Polygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};
  const bool works = pipeline.counts().frames == 0 &&
                     occusg::intersectionArea(square, occusg::translated(square, 1, 0)) == 2.0;
  std::cout << (works ? "works" : "does not work") << '\n';
  return works ? 0 : 1;
}

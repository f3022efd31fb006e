// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// The edge from each object to the navigation node nearest to it in the ground plane (paper, Sec.
/// 3.4), if one is near enough. Another takes its place when it is nearer by more than 0.05 m.
class FreeSpaceLinks {
 public:
  explicit FreeSpaceLinks(double max_distance_m);

  /// Looks at the objects that changed and at those near navigation nodes that did. Always to be
  /// called with the same graph.
  void update(SceneGraph& graph);

 private:
  void link(SceneGraph& graph, NodeId object) const;

  double max_distance_m_;
  Revision revision_ = 0;
};

}  // namespace occusg

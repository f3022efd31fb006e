// SPDX-License-Identifier: BSD-3-Clause
// Asks a scene graph which room a place is in, what is in it and how to get to another place.
// Usage: 03_query_graph SCENE_GRAPH.json X Y TO_X TO_Y          metres in the map frame
#include <cstdlib>
#include <iostream>

#include "occusg/occusg.hpp"

int main(int argc, char** argv) {
  if (argc != 6) {
    std::cerr << "usage: 03_query_graph SCENE_GRAPH.json X Y TO_X TO_Y\n";
    return 2;
  }
  try {
    const occusg::SceneGraph graph = occusg::readSceneGraph(argv[1]).graph;
    const occusg::Point2 from{std::atof(argv[2]), std::atof(argv[3])};
    const occusg::Point2 to{std::atof(argv[4]), std::atof(argv[5])};
    const std::optional<occusg::NodeId> room = occusg::roomAt(graph, from, 0.5);
    if (!room) {
      std::cout << "the first place is in no room\n";
      return 0;
    }
    std::cout << "the first place is in " << graph.room(*room).name << ", with "
              << occusg::objectsIn(graph, *room).size() << " objects and "
              << occusg::adjacentRooms(graph, *room).size() << " rooms beside it\n";
    const std::optional<occusg::Route> route = occusg::shortestRoute(graph, from, to);
    if (!route) {
      std::cout << "no way leads to the second\n";
      return 0;
    }
    std::cout << "the way to the second is " << route->length_m << " m long and leads through";
    for (const occusg::NodeId passed : route->rooms) std::cout << ' ' << graph.room(passed).name;
    std::cout << '\n';
  } catch (const occusg::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

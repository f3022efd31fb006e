// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "occusg/parameter.hpp"

namespace occusg {

/// The published system says "sampled"; these are the values it was run with.
struct AgentLayerConfig {
  double min_distance_m = 0.5;   ///< A pose so far from the last agent becomes one [m], 3D.
  double max_interval_s = 10.0;  ///< A pose this much later than the last agent becomes one [s].
  /// Of older agents only the last at each place stays [s], positive.
  double recent_s = 3600.0;
  double old_spacing_m = 1.0;  ///< Side of the cubes that are one place for them [m], positive.
  int max_agents = 20'000;     ///< Beyond it the oldest go, [2, kMaxGraphNodes / 2].
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(AgentLayerConfig& config);

/// What makes a room of a region the robot has not entered.
enum class PromotionEvidence {
  kAnyEntity,     ///< One agent, object or navigation node in it (paper, Sec. 3.3).
  kObservedArea,  ///< Enough free area, for long enough.
};

/// Relinking values are those of the published system's code; its text gives none.
struct RoomLayerConfig {
  double boundary_tolerance_m = 0.5;  ///< A region also holds what is this near to it [m].
  double floor_z_m = 0.0;             ///< Height of room nodes in the map frame [m].

  double relink_min_overlap = 0.65;  ///< Share of the room its successor must cover, 0..1.
  double relink_min_members = 0.5;   ///< Share of the room's members it must hold, 0..1.
  /// The same for a successor that does not hold the room's centroid, 0..1.
  double relink_min_members_off_centre = 0.75;
  double relink_min_margin = 0.15;  ///< Lead over the second best successor, of a score in 0..1.

  PromotionEvidence promotion = PromotionEvidence::kObservedArea;
  double min_promoted_area_m2 = 1.0;  ///< kObservedArea: smallest region that becomes a room [m2].
  double min_promoted_age_s = 4.0;    ///< kObservedArea: once it has been known for so long [s].

  /// A room is confirmed once no more than this share of its boundary is frontier, 0..1; until then
  /// it is partial. One: every room is confirmed.
  double max_frontier_share = 0.3;

  /// A room stays for so long after its region went missing, and at least while the tracker
  /// remembers the region [s]. Zero: exactly while it does (paper, Sec. 3.3).
  double removal_grace_s = 10.0;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(RoomLayerConfig& config);

enum class ObjectMemory {
  /// An object keeps what was first seen of it; later detections are only counted (paper,
  /// Sec. 3.4).
  kFirstSight,
  /// Detections of overlapping boxes make up one object: mean place, common box, class histogram.
  kRunning,
};

enum class GhostRemoval {
  kNever,
  kSeenThrough,  ///< An object goes when the space it filled has been seen to be free.
};

/// Which detections are one object, and when an object goes.
struct ObjectLayerConfig {
  ObjectMemory memory = ObjectMemory::kRunning;
  double merge_distance_m =
      0.75;  ///< kFirstSight: objects of one class nearer than this are one [m], 3D.
  double flicker_distance_m =
      0.15;  ///< kFirstSight: objects of any class nearer than this are one [m].
  /// kRunning: same class with so much of the smaller box in common is one object, 0..1.
  double min_common_box = 0.3;
  GhostRemoval ghosts = GhostRemoval::kSeenThrough;
  int ghost_checks = 3;              ///< So many looks in a row must find the space free.
  double max_link_distance_m = 1.0;  ///< To the nearest navigation node [m].
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(ObjectLayerConfig& config);

/// What stands for a block of free space.
enum class NavigationNodes {
  /// One node in the middle of the block, wall or not; two blocks are joined when free cells of the
  /// two lead from one to the other, corners of obstacles cut or not (paper, Sec. 3.4).
  kOnePerBlock,
  /// One node on each connected part of its free cells, joined to the parts it touches; a step past
  /// a corner needs the cells on both sides of it free, and an edge a straight line over free
  /// cells.
  kOnePerPart,
};

/// Where navigation nodes stand.
struct NavigationLayerConfig {
  int block_cells = 15;     ///< Side of a block [cells], 2..64.
  int min_free_cells = 25;  ///< A node is made when it stands for so many free cells.
  int min_kept_cells = 15;  ///< And removed when they are fewer; zero: never.
  NavigationNodes nodes = NavigationNodes::kOnePerPart;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(NavigationLayerConfig& config);

/// What speaks for a kind of room: the weight of each object class, by `classKey`.
using RoomLabelTable = std::map<std::string, std::map<std::string, double>>;

/// The table of `config/room_labels.yaml`.
[[nodiscard]] RoomLabelTable defaultRoomLabels();

/// Of the graph stage.
struct GraphBuilderConfig {
  double maintenance_period_s = 2.0;  ///< Of relinking, promotion and removal (paper: 0.5 Hz) [s].
  AgentLayerConfig agents;
  RoomLayerConfig rooms;
  ObjectLayerConfig objects;
  NavigationLayerConfig navigation;
  RoomLabelTable room_labels = defaultRoomLabels();
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(GraphBuilderConfig& config);

}  // namespace occusg

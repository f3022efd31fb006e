// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "occusg/mapping/occupancy_map.hpp"

namespace occusg {

/// OctoMap's two kinds of map files (Hornung et al., Autonomous Robots 2013, Sec. 4.3).
enum class OctomapEncoding {
  kBinary,  ///< `.bt`: free, occupied or unknown, two bits a child.
  kFull,    ///< `.ot`: the log-odds of every node.
};

/// What a map file says of itself in the text at its beginning.
struct OctomapHeader {
  OctomapEncoding encoding = OctomapEncoding::kBinary;
  std::string tree_type;       ///< "OcTree" or "ColorOcTree", whose colours are left out.
  std::size_t node_count = 0;  ///< Inner nodes and leaves, as declared.
  double resolution_m = 0.0;   ///< Voxel edge.
  std::size_t data_begin = 0;  ///< Offset of the first byte after the text.
};

/// Nodes beyond which no map is read: several GiB in memory.
inline constexpr std::size_t kMaxOctomapNodes = std::size_t{1} << 26U;
/// Longest text a map may begin with [bytes].
inline constexpr std::size_t kMaxOctomapHeaderBytes = std::size_t{1} << 16U;

/// Reads no more than the beginning of the file.
/// @throws Error as `readOctomap`, for what the text says.
[[nodiscard]] OctomapHeader readOctomapHeader(const std::string& path);

/// Reads a saved map, `.bt` or `.ot` (told apart by their first line). All bytes are checked before
/// anything is built: a file that is refused costs its own size in memory and one pass. In a `.bt`
/// the voxels get the clamping values of `config`, as OctoMap does.
/// @param config of the map; its resolution must be the file's (within 1e-5 of it).
/// @param assumptions receives a sentence when a whole tree has another number of nodes than
/// declared, as some programs write; without it such a file is refused.
/// @throws Error naming the file and the fault: missing, no OctoMap file, of another tree type, a
/// resolution or node count that is no such thing, more than `max_nodes`, voxels beyond
/// `max_memory_mb` of `config`, cut short, followed by more bytes, deeper than 16 levels, an inner
/// node without children, log-odds that are not finite, one single node that would fill all space.
[[nodiscard]] OccupancyMap readOctomap(const std::string& path, const OccupancyMapConfig& config,
                                       std::size_t max_nodes = kMaxOctomapNodes,
                                       std::vector<std::string>* assumptions = nullptr);

/// The bytes of a map file that OctoMap's own reader takes, and `readOctomap`.
[[nodiscard]] std::string toOctomap(const octomap::OcTree& tree, OctomapEncoding encoding);
/// The same, node by node: a large map's bytes never stand in memory.
/// @throws Error when it has more nodes than `readOctomap` takes, kMaxOctomapNodes.
void writeOctomap(const octomap::OcTree& tree, OctomapEncoding encoding, std::ostream& out);

}  // namespace occusg

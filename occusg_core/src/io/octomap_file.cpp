// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/octomap_file.hpp"

#include <cmath>
#include <cstdint>
#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/json_text.hpp"
#include "io/octomap_scan.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

/// Largest node of either encoding: log-odds, colour, children.
constexpr std::size_t kMaxNodeBytes = 8;

void checkNodeCount(const OctomapHeader& header, const std::string& path, std::size_t max_nodes) {
  if (header.node_count <= max_nodes) return;
  throw refuse(path, "declares " + std::to_string(header.node_count) + " nodes",
               "at most " + std::to_string(max_nodes) + " are read");
}

void checkResolution(const OctomapHeader& header, const std::string& path, double configured_m) {
  constexpr double kRounding = 1e-5;  // OctoMap writes six digits
  if (std::abs(header.resolution_m - configured_m) <= kRounding * configured_m) return;
  throw refuse(path, "has voxels of " + toText(header.resolution_m) + " m",
               "the configured resolution of " + toText(configured_m) + " m is needed");
}

/// The nodes of a `.ot` as `octomap::OcTree` stores them.
std::string withoutColors(const std::string& bytes, const OctomapHeader& header) {
  const std::size_t stride = octomapNodeBytes(header);
  std::string plain;
  plain.reserve(header.node_count * (sizeof(float) + 1));
  for (std::size_t at = header.data_begin; at < bytes.size(); at += stride) {
    plain.append(bytes, at, sizeof(float));
    plain.push_back(bytes[at + stride - 1]);
  }
  return plain;
}

std::unique_ptr<octomap::OcTree> treeOf(std::string bytes, const OctomapHeader& header,
                                        const OccupancyMapConfig& config) {
  auto tree = std::make_unique<octomap::OcTree>(config.resolution_m);
  tree->setClampingThresMin(config.min_probability);
  tree->setClampingThresMax(config.max_probability);
  if (header.node_count == 0) return tree;
  const bool has_colors =
      header.encoding == OctomapEncoding::kFull && header.tree_type == "ColorOcTree";
  std::istringstream data(has_colors ? withoutColors(bytes, header)
                                     : std::move(bytes.erase(0, header.data_begin)));
  if (header.encoding == OctomapEncoding::kBinary) {
    tree->readBinaryData(data);
  } else {
    tree->readData(data);
  }
  return tree;
}

}  // namespace

OctomapHeader readOctomapHeader(const std::string& path) {
  return scanOctomapHeader(readBeginning(path, kMaxOctomapHeaderBytes), path);
}

OccupancyMap readOctomap(const std::string& path, const OccupancyMapConfig& config,
                         std::size_t max_nodes, std::vector<std::string>* assumptions) {
  const OctomapHeader announced = readOctomapHeader(path);
  checkNodeCount(announced, path, max_nodes);
  checkResolution(announced, path, config.resolution_m);
  const std::size_t likely_nodes = assumptions == nullptr ? announced.node_count : max_nodes;
  std::string bytes = readFile(path, kMaxOctomapHeaderBytes + kMaxNodeBytes * likely_nodes);
  OctomapHeader header = scanOctomapHeader(bytes, path);
  checkNodeCount(header, path, max_nodes);
  const std::size_t nodes = checkOctomapData(bytes, header, path, config.max_memory_mb);
  if (nodes != header.node_count) {
    const std::string declared = std::to_string(header.node_count) + " are declared";
    if (assumptions == nullptr)
      throw refuse(path, "holds " + std::to_string(nodes) + " nodes", declared);
    assumptions->push_back("holds " + std::to_string(nodes) + " nodes, " + declared +
                           "; the tree is whole and was read");
    header.node_count = nodes;
  }
  return OccupancyMap(config, treeOf(std::move(bytes), header, config));
}

void writeOctomap(const octomap::OcTree& tree, OctomapEncoding encoding, std::ostream& out) {
  if (tree.size() > kMaxOctomapNodes) {
    throw refuse("map", "has " + std::to_string(tree.size()) + " nodes",
                 "at most " + std::to_string(kMaxOctomapNodes) + " can be read back");
  }
  const bool is_binary = encoding == OctomapEncoding::kBinary;
  out << (is_binary ? "# Octomap OcTree binary file\n" : "# Octomap OcTree file\n")
      << "# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
      << "id OcTree\nsize " << std::to_string(tree.size()) << "\nres "
      << toText(tree.getResolution()) << "\ndata\n";
  if (tree.size() == 0) return;
  if (is_binary) {
    tree.writeBinaryData(out);
  } else {
    tree.writeData(out);
  }
}

std::string toOctomap(const octomap::OcTree& tree, OctomapEncoding encoding) {
  std::ostringstream file;
  writeOctomap(tree, encoding, file);
  return file.str();
}

}  // namespace occusg

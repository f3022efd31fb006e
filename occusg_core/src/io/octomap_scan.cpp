// SPDX-License-Identifier: BSD-3-Clause
#include "io/octomap_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr const char* kBinaryFirstLine = "# Octomap OcTree binary file";
constexpr const char* kFullFirstLine = "# Octomap OcTree file";
constexpr unsigned kTreeDepth = 16;
/// Nodes so deep stand for a block of 8 x 8 x 8 voxels, which costs so much in the map's columns.
constexpr unsigned kBlockDepth = 13;
constexpr double kBytesPerBlock = 272.0;
constexpr double kMebibyte = 1048576.0;
constexpr double kFinest_m = 0.001;
constexpr double kCoarsest_m = 10.0;

bool startsWith(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

std::optional<OctomapEncoding> encodingOf(const std::string& bytes) {
  if (startsWith(bytes, kBinaryFirstLine)) return OctomapEncoding::kBinary;
  if (startsWith(bytes, kFullFirstLine)) return OctomapEncoding::kFull;
  return std::nullopt;
}

std::size_t countIn(const std::string& word, const std::string& where) {
  constexpr std::size_t kMaxDigits = 18;
  const bool is_count =
      !word.empty() && word.size() <= kMaxDigits &&
      std::all_of(word.begin(), word.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  if (!is_count)
    throw refuse(where, "size is \"" + shown(word) + "\"", "a number of nodes is needed");
  return std::stoull(word);
}

double resolutionIn(const std::string& word, const std::string& where) {
  const std::optional<double> resolution_m = numberIn(word);
  if (!resolution_m || *resolution_m < kFinest_m || *resolution_m > kCoarsest_m) {
    throw refuse(where, "res is \"" + shown(word) + "\"",
                 "a voxel edge between 0.001 and 10 m is needed");
  }
  return *resolution_m;
}

std::string typeIn(const std::string& word, const std::string& where) {
  if (word == "OcTree" || word == "ColorOcTree") return word;
  throw refuse(where, "id is \"" + shown(word) + "\"", "OcTree or ColorOcTree is needed");
}

/// Reads the lines of the text; a key that is given twice counts the last time, as in OctoMap.
class HeaderReader {
 public:
  HeaderReader(const OctomapHeader& header, std::string where)
      : header_(header), where_(std::move(where)) {}

  void read(const std::string& line, std::size_t number) {
    const std::vector<std::string> words = wordsOf(line);
    if (words.empty() || words.front().front() == '#') return;
    const std::string& key = words.front();
    const std::string where = where_ + ":" + std::to_string(number);
    const std::string value = words.size() == 2 ? words[1] : "";
    if (key == "id") {
      header_.tree_type = typeIn(value, where);
    } else if (key == "size") {
      node_count_ = countIn(value, where);
    } else if (key == "res") {
      header_.resolution_m = resolutionIn(value, where);
    } else {
      throw refuse(where, "begins with \"" + shown(key) + "\"", "id, size, res or data is needed");
    }
  }

  [[nodiscard]] OctomapHeader finished(std::size_t data_begin) {
    const char* missing = header_.tree_type.empty()     ? "id"
                          : !node_count_                ? "size"
                          : header_.resolution_m == 0.0 ? "res"
                                                        : nullptr;
    if (missing != nullptr) {
      throw refuse(where_, std::string("has no line \"") + missing + "\" before its data",
                   "id, size, res and data are needed");
    }
    header_.node_count = *node_count_;
    header_.data_begin = data_begin;
    return header_;
  }

 private:
  OctomapHeader header_;
  std::optional<std::size_t> node_count_;
  std::string where_;
};

/// Walks over the nodes of a tree, in the order both encodings share: depth first, children by
/// index. Recursion ends at the depth of the tree whatever the bytes say.
class DataScan {
 public:
  DataScan(const std::string& bytes, const OctomapHeader& header, const std::string& where,
           double max_memory_mb)
      : bytes_(bytes),
        header_(header),
        where_(where),
        max_blocks_(max_memory_mb * kMebibyte / kBytesPerBlock),
        at_(header.data_begin) {}

  void run() {
    if (header_.node_count > 0 || at_ < bytes_.size()) {
      count();
      if (header_.encoding == OctomapEncoding::kBinary) {
        scanBinaryNode(0);
      } else {
        scanFullNode(0);
      }
    }
    if (at_ != bytes_.size()) {
      throw refuse(where_,
                   "goes on for " + std::to_string(bytes_.size() - at_) + " bytes after its " +
                       std::to_string(nodes_) + " nodes",
                   "nothing may follow the tree");
    }
  }

  [[nodiscard]] std::size_t nodes() const { return nodes_; }

 private:
  [[nodiscard]] std::string declared() const {
    return std::to_string(header_.node_count) + " are declared";
  }

  void count() { ++nodes_; }

  /// A node without children at `depth` stands for a cube of blocks; at most one for the deepest.
  void countBlocks(unsigned depth) {
    blocks_ +=
        depth >= kBlockDepth ? 1.0 : std::ldexp(1.0, 3 * static_cast<int>(kBlockDepth - depth));
    if (blocks_ <= max_blocks_) return;
    throw refuse(where_,
                 "stands for more than " + std::to_string(static_cast<std::int64_t>(max_blocks_)) +
                     " blocks of 8 x 8 x 8 voxels",
                 "a map that fits into mapping.occupancy.max_memory_mb is needed");
  }

  const char* take(std::size_t size) {
    if (bytes_.size() - at_ < size) {
      throw refuse(where_,
                   "ends at byte " + std::to_string(bytes_.size()) + " after " +
                       std::to_string(nodes_) + " nodes",
                   declared());
    }
    const char* const taken = bytes_.data() + at_;
    at_ += size;
    return taken;
  }

  void checkDepth(unsigned depth) const {
    if (depth < kTreeDepth) return;
    throw refuse(where_, "has a node below level 16 at byte " + std::to_string(at_),
                 "a tree of at most 16 levels is needed");
  }

  void requireChildren(bool has_children) const {
    if (has_children) return;
    throw refuse(where_, "has an inner node without children at byte " + std::to_string(at_),
                 "a tree whose inner nodes have children is needed");
  }

  /// Two bits a child, low bits first: 0 none, 1 free, 2 occupied, 3 inner.
  void scanBinaryNode(unsigned depth) {
    checkDepth(depth);
    constexpr unsigned kInner = 3;
    const char* const record = take(2);
    const unsigned children = static_cast<unsigned char>(record[0]) |
                              static_cast<unsigned>(static_cast<unsigned char>(record[1])) << 8U;
    requireChildren(children != 0);
    if (depth == kBlockDepth) countBlocks(depth);
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned state = (children >> (2 * i)) & 3U;
      if (state != 0) count();
      if (state != 0 && state != kInner && depth < kBlockDepth) countBlocks(depth + 1);
    }
    for (unsigned i = 0; i < 8; ++i)
      if (((children >> (2 * i)) & 3U) == kInner) scanBinaryNode(depth + 1);
  }

  void scanFullNode(unsigned depth) {
    const std::size_t begin = at_;
    const std::size_t size = octomapNodeBytes(header_);
    const char* const record = take(size);
    float log_odds = 0.0F;
    std::memcpy(&log_odds, record, sizeof(log_odds));
    if (!std::isfinite(log_odds)) {
      throw refuse(where_, "has log-odds that are not finite at byte " + std::to_string(begin),
                   "finite numbers are needed");
    }
    const unsigned children = static_cast<unsigned char>(record[size - 1]);
    if (depth == 0) requireChildren(children != 0);
    if (children != 0) checkDepth(depth);
    if (depth == kBlockDepth || (children == 0 && depth < kBlockDepth)) countBlocks(depth);
    for (unsigned i = 0; i < 8; ++i) {
      if (((children >> i) & 1U) == 0) continue;
      count();
      scanFullNode(depth + 1);
    }
  }

  const std::string& bytes_;
  const OctomapHeader& header_;
  const std::string& where_;
  double max_blocks_;
  std::size_t at_;
  std::size_t nodes_ = 0;
  double blocks_ = 0.0;  ///< That the tree's voxels fill.
};

/// The header of OctoMap before 1.0: tree type 3, resolution and node count in binary, then a
/// `.bt`'s data.
std::optional<OctomapHeader> legacyHeader(const std::string& bytes) {
  constexpr std::int32_t kLegacyOcTree = 3;
  constexpr std::size_t kLegacyBytes =
      sizeof(std::int32_t) + sizeof(double) + sizeof(std::uint32_t);
  if (bytes.size() < kLegacyBytes) return std::nullopt;
  std::int32_t type = 0;
  double resolution_m = 0.0;
  std::uint32_t nodes = 0;
  std::memcpy(&type, bytes.data(), sizeof(type));
  std::memcpy(&resolution_m, bytes.data() + sizeof(type), sizeof(resolution_m));
  std::memcpy(&nodes, bytes.data() + sizeof(type) + sizeof(resolution_m), sizeof(nodes));
  if (type != kLegacyOcTree || !(resolution_m >= kFinest_m && resolution_m <= kCoarsest_m))
    return std::nullopt;
  OctomapHeader header;
  header.encoding = OctomapEncoding::kBinary;
  header.tree_type = "OcTree";
  header.node_count = nodes;
  header.resolution_m = resolution_m;
  header.data_begin = kLegacyBytes;
  return header;
}

}  // namespace

OctomapHeader scanOctomapHeader(const std::string& bytes, const std::string& where) {
  if (const std::optional<OctomapHeader> legacy = legacyHeader(bytes)) return *legacy;
  const std::optional<OctomapEncoding> encoding = encodingOf(bytes);
  if (!encoding) {
    throw refuse(where, "is no OctoMap file",
                 std::string("its first line must be \"") + kBinaryFirstLine + "\" or \"" +
                     kFullFirstLine + "\"");
  }
  OctomapHeader header;
  header.encoding = *encoding;
  HeaderReader reader(header, where);
  const std::size_t limit = std::min(bytes.size(), kMaxOctomapHeaderBytes);
  std::size_t number = 0;
  for (std::size_t start = 0; start < limit;) {
    const std::size_t end = bytes.find('\n', start);
    if (end == std::string::npos || end >= limit) break;
    const std::string line = bytes.substr(start, end - start);
    ++number;
    start = end + 1;
    if (line == "data") return reader.finished(start);
    reader.read(line, number);
  }
  throw refuse(where, "has no line \"data\" in its first " + std::to_string(limit) + " bytes",
               "a whole OctoMap file is needed");
}

std::size_t checkOctomapData(const std::string& bytes, const OctomapHeader& header,
                             const std::string& where, double max_memory_mb) {
  DataScan scan(bytes, header, where, max_memory_mb);
  scan.run();
  return scan.nodes();
}

std::size_t octomapNodeBytes(const OctomapHeader& header) {
  constexpr std::size_t kColorBytes = 3;
  return sizeof(float) + (header.tree_type == "ColorOcTree" ? kColorBytes : 0) + 1;
}

}  // namespace occusg

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/settled_voxels.hpp"

namespace occusg {

const SettledBlock& SettledVoxels::of(std::uint64_t code) const {
  static const SettledBlock kNone;
  const auto found = blocks_.find(code);
  return found == blocks_.end() ? kNone : found->second;
}

std::size_t SettledVoxels::memoryBytes() const {
  constexpr std::size_t kNode = sizeof(std::uint64_t) + sizeof(SettledBlock) + sizeof(void*);
  return blocks_.size() * kNode + blocks_.bucket_count() * sizeof(void*);
}

}  // namespace occusg

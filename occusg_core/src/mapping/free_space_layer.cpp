// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/free_space_layer.hpp"

#include "mapping/free_space_projection.hpp"

namespace occusg {

FreeSpaceLayer::FreeSpaceLayer(const FreeSpaceLayerConfig& config, const GridFrame& frame)
    : projection_(std::make_unique<FreeSpaceProjection>(config, frame)) {}

FreeSpaceLayer::FreeSpaceLayer(const FreeSpaceLayer& other)
    : projection_(std::make_unique<FreeSpaceProjection>(*other.projection_)) {}

FreeSpaceLayer& FreeSpaceLayer::operator=(const FreeSpaceLayer& other) {
  if (this != &other) *projection_ = *other.projection_;
  return *this;
}

FreeSpaceLayer::FreeSpaceLayer(FreeSpaceLayer&&) noexcept = default;
FreeSpaceLayer& FreeSpaceLayer::operator=(FreeSpaceLayer&&) noexcept = default;
FreeSpaceLayer::~FreeSpaceLayer() = default;

const FreeSpace& FreeSpaceLayer::update(const OccupancyMap& map, const MapChange& change) {
  return projection_->update(map, change);
}

const FreeSpace& FreeSpaceLayer::recompute(const OccupancyMap& map) {
  return projection_->recompute(map);
}

const FreeSpace& FreeSpaceLayer::confine(const OccupancyMap& map, const HeightSpan& span) {
  return projection_->confine(map, span);
}

bool FreeSpaceLayer::canCover(const CellBox& box) const { return projection_->canCover(box); }

const FreeSpace& FreeSpaceLayer::freeSpace() const { return projection_->freeSpace(); }

void FreeSpaceLayer::reset() { projection_->reset(); }

std::size_t FreeSpaceLayer::memoryBytes() const { return projection_->memoryBytes(); }

}  // namespace occusg

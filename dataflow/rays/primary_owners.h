// Whose a primary ray is, in every one of several ways to share space out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/units.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/joint_lattice.h"
#include "dataflow/regions/lattice_walk.h"
#include "dataflow/regions/regions.h"

namespace dmpc::dataflow {

/// The nodes that share the sky of one partition: all but those whose regions hold nothing, unless that is all. Asked for pixels
/// by their places, in ascending order.
class SkyOwners {
 public:
  SkyOwners(const Regions& partition, std::uint32_t pixel_count);

  /// Whose a pixel of the sky is.
  std::uint16_t owner_of(std::uint32_t place) {
    if (place >= end_) {
      take(place);
    }
    return owner_;
  }
  /// The first place behind the last one asked for that may have another owner.
  std::uint32_t end() const { return end_; }

 private:
  void take(std::uint32_t place);

  std::vector<std::uint16_t> nodes_;
  std::uint32_t pixel_count_;
  std::uint16_t owner_ = 0;
  std::uint32_t end_ = 0;
};

/// Goes through the primary rays of a picture, in ascending order, and knows the owner of each by partition: who has the first
/// region on its way that holds something, or its share of the sky. Most rays have the owners of the ray before them. Not
/// thread-safe.
class PrimaryOwners {
 public:
  /// `settings` outlive it. Requires 1 to JointLattice::partitions_max partitions of one grid.
  PrimaryOwners(const core::RenderSettings& settings, std::span<const Regions> partitions);

  /// Goes to a ray, of the pixel at a place. Returns the partitions in which its owner is not that of the ray before, a bit each:
  /// at first, where it is not node 0.
  std::uint64_t find(std::uint32_t place, std::uint32_t pixel, std::uint32_t sample);
  /// A bit for each.
  std::uint64_t all_partitions() const { return lattice_.all_partitions(); }
  /// Who has the ray found last, by partition.
  std::span<const std::uint16_t> owners() const { return owners_; }

 private:
  std::uint64_t follow(std::uint32_t place);
  std::uint64_t take_cell(std::uint64_t partitions, std::size_t cell);
  std::uint64_t take_sky(std::uint64_t partitions, std::uint32_t place);
  std::uint64_t take(std::size_t partition, std::uint16_t owner);

  const core::RenderSettings& settings_;
  JointLattice lattice_;
  LatticeWalk walk_;
  std::vector<SkyOwners> sky_;
  std::vector<std::uint16_t> owners_;
  std::array<std::size_t, JointLattice::partitions_max>
      deciding_{};  ///< the cells that gave the ray found last its owners, in order
  std::size_t deciding_count_ = 0;
  bool is_sky_ = false;        ///< the ray found last has owners of the sky alone
  std::uint32_t sky_end_ = 0;  ///< if so: the first place where one of them is another
};

}  // namespace dmpc::dataflow

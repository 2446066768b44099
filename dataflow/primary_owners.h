// Whose a primary ray is, in every one of several ways to share space out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/units.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/regions/joint_lattice.h"
#include "dataflow/regions/lattice_walk.h"

namespace dmpc::dataflow {

/// The nodes that share the sky of one Bsp: all but those whose region holds nothing, unless that is all. Asked for pixels in
/// ascending order.
class SkyOwners {
 public:
  SkyOwners(const Bsp& bsp, std::uint32_t pixel_count);

  /// Whose a pixel of the sky is.
  std::uint16_t owner_of(std::uint32_t pixel) {
    if (pixel >= end_) {
      take(pixel);
    }
    return owner_;
  }
  /// The first pixel behind the last one asked for that may have another owner.
  std::uint32_t end() const { return end_; }

 private:
  void take(std::uint32_t pixel);

  std::vector<std::uint16_t> nodes_;
  std::uint32_t pixel_count_;
  std::uint16_t owner_ = 0;
  std::uint32_t end_ = 0;
};

/// Goes through the primary rays of a picture, in ascending order, and knows the owner of each by Bsp: who has the first region
/// on its way that holds something, or its share of the sky. Most rays have the owners of the ray before them, which takes one
/// comparison to see. Not thread-safe.
class PrimaryOwners {
 public:
  /// `settings` outlive it. Requires 1 to JointLattice::bsps_max Bsps of one grid.
  PrimaryOwners(const core::RenderSettings& settings, std::span<const Bsp> bsps);

  /// Goes to a ray; false if all owners are certain to be those of the ray before.
  bool find(std::uint32_t pixel, std::uint32_t sample);
  /// Of the ray found last, by Bsp.
  std::span<const std::uint16_t> owners() const { return owners_; }

 private:
  /// What is known of the ray before, instead of the cell in which it enters: its owners were found on its way, or in the sky.
  static constexpr std::size_t on_the_way = ~std::size_t{0}, in_the_sky = on_the_way - 1;

  std::uint64_t follow();
  void take_sky(std::uint64_t bsps, std::uint32_t pixel);

  const core::RenderSettings& settings_;
  JointLattice lattice_;
  LatticeWalk walk_;
  std::vector<SkyOwners> sky_;
  std::vector<std::uint16_t> owners_;
  std::size_t before_ = on_the_way;  ///< the cell that gave all owners of the ray before, or one of the above
  std::uint32_t sky_end_ = 0;        ///< the first pixel where the owner of the sky changes in some Bsp
};

}  // namespace dmpc::dataflow

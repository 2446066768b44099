// The owner of a primary ray, in each of several partitions of space.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/joint_lattice.h"
#include "dataflow/regions/lattice_traversal.h"
#include "dataflow/regions/regions.h"

namespace dmpc::dataflow {

/// The nodes that share the sky of one partition: all except those whose regions are empty, unless that is all. To be called for
/// pixels by their places, in ascending order.
class SkyOwners {
 public:
  SkyOwners(const Regions& partition, std::uint32_t pixel_count) : pixel_count_(pixel_count) {
    std::vector<bool> holds(partition.node_count(), false);
    for (std::uint32_t index = 0; index < partition.region_count(); ++index) {
      holds[nodes::index_of(partition.owner_at(index))] =
          holds[nodes::index_of(partition.owner_at(index))] || !partition.is_empty(index);
    }
    const bool is_anywhere = std::find(holds.begin(), holds.end(), true) != holds.end();
    for (std::uint32_t node = 0; node < partition.node_count(); ++node) {
      if (holds[node] || !is_anywhere) {
        nodes_.push_back(static_cast<std::uint16_t>(node));
      }
    }
  }

  /// The owner of a sky pixel.
  std::uint16_t owner_of(std::uint32_t place) {
    if (place >= end_) {
      take(place);
    }
    return owner_;
  }
  /// The first place after the last requested one that may have another owner.
  std::uint32_t end() const { return end_; }

 private:
  void take(std::uint32_t place) {
    const std::uint64_t share = std::uint64_t{place} * nodes_.size() / pixel_count_;
    owner_ = nodes_[share];
    end_ = static_cast<std::uint32_t>(core::ceil_divide((share + 1) * pixel_count_, std::uint64_t{nodes_.size()}));
  }

  std::vector<std::uint16_t> nodes_;
  std::uint32_t pixel_count_;
  std::uint16_t owner_ = 0;
  std::uint32_t end_ = 0;
};

/// Iterates over the primary rays of a picture, in ascending order, and finds the owner of each by partition: the node of the
/// first region on its way that is not empty, or that of its share of the sky. Most rays have the owners of the ray before them.
/// Not thread-safe.
class PrimaryOwners {
 public:
  /// `settings` outlive it. Requires 1 to JointLattice::partitions_max partitions of one grid.
  PrimaryOwners(const core::RenderSettings& settings, std::span<const Regions> partitions)
      : settings_(settings), lattice_(partitions), walk_(lattice_, settings.header.frame), owners_(partitions.size()) {
    for (const Regions& partition : partitions) {
      sky_.emplace_back(partition, settings.camera.pixel_count());
    }
  }

  /// Moves to a ray, of the pixel at a place. Returns the partitions in which its owner differs from that of the ray before, a
  /// bit each: for the first ray, those where it is not node 0.
  std::uint64_t find(std::uint32_t place, std::uint32_t pixel, std::uint32_t sample) {
    const bool was_sky = is_sky_;
    is_sky_ = settings_.shows_background(pixel) || !walk_.enter(settings_.camera.primary_ray(pixel, sample));
    if (!is_sky_) {
      return follow(place);
    }
    deciding_count_ = 0;
    return was_sky && place < sky_end_ ? 0 : take_sky(lattice_.all_partitions(), place);
  }

  /// A bit for each.
  std::uint64_t all_partitions() const { return lattice_.all_partitions(); }
  /// The owner of the current ray, by partition.
  std::span<const std::uint16_t> owners() const { return owners_; }

 private:
  /// Sets the owner in each partition from the first cell on the way that is occupied there, or from the sky. Returns the
  /// partitions that change.
  std::uint64_t follow(std::uint32_t place) {
    std::uint64_t left = lattice_.all_partitions(), changed = 0;
    std::size_t count = 0;
    bool is_as_before = true;  // the cells that decide are those of the ray before, and so are the owners
    do {
      const std::size_t cell = walk_.cell();
      const std::uint64_t decided = left & lattice_.occupied(cell);
      if (decided != 0) {
        is_as_before = is_as_before && count < deciding_count_ && deciding_[count] == cell;
        changed |= is_as_before ? 0 : take_cell(decided, cell);
        deciding_[count++] = cell;
        left &= ~decided;
      }
    } while (left != 0 && walk_.advance());
    deciding_count_ = count;
    return changed | take_sky(left, place);
  }

  std::uint64_t take_cell(std::uint64_t partitions, std::size_t cell) {
    const std::span<const std::uint16_t> owners = lattice_.owners(cell);
    std::uint64_t changed = 0;
    for (; partitions != 0; partitions &= partitions - 1) {
      const auto partition = static_cast<std::size_t>(std::countr_zero(partitions));
      changed |= take(partition, owners[partition]);
    }
    return changed;
  }

  std::uint64_t take_sky(std::uint64_t partitions, std::uint32_t place) {
    std::uint64_t changed = 0;
    sky_end_ = std::numeric_limits<std::uint32_t>::max();
    for (; partitions != 0; partitions &= partitions - 1) {
      const auto partition = static_cast<std::size_t>(std::countr_zero(partitions));
      changed |= take(partition, sky_[partition].owner_of(place));
      sky_end_ = std::min(sky_end_, sky_[partition].end());
    }
    return changed;
  }

  /// Returns the partition's bit if that changes its owner.
  std::uint64_t take(std::size_t partition, std::uint16_t owner) {
    const bool is_other = std::exchange(owners_[partition], owner) != owner;
    return std::uint64_t{is_other ? 1U : 0U} << partition;
  }

  const core::RenderSettings& settings_;
  JointLattice lattice_;
  LatticeTraversal walk_;
  std::vector<SkyOwners> sky_;
  std::vector<std::uint16_t> owners_;
  std::array<std::size_t, JointLattice::partitions_max>
      deciding_{};  ///< the cells that determined the owners of the current ray, in order
  std::size_t deciding_count_ = 0;
  bool is_sky_ = false;        ///< the current ray has only owners of the sky
  std::uint32_t sky_end_ = 0;  ///< if so: the first place where one of them differs
};

}  // namespace dmpc::dataflow

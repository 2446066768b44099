#include "dataflow/regions/joint_lattice.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::dataflow {
namespace {

using Planes = std::array<std::vector<std::int32_t>, 3>;

/// The planes at the grid's ends and at all cuts between them.
Planes planes_of(std::span<const Regions> partitions) {
  const core::Corner& size = partitions.front().grid_size();
  Planes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = {0, size[axis]};
  }
  for (const Regions& regions : partitions) {
    regions.for_each_plane([&](std::size_t axis, std::int32_t at) {
      if (at > 0 && at < size[axis]) {
        planes[axis].push_back(at);
      }
    });
  }
  for (std::vector<std::int32_t>& along : planes) {
    std::sort(along.begin(), along.end());
    along.erase(std::unique(along.begin(), along.end()), along.end());
  }
  return planes;
}

std::size_t cell_count(const Planes& planes) { return (planes[0].size() - 1) * (planes[1].size() - 1) * (planes[2].size() - 1); }

}  // namespace

std::size_t JointLattice::owner_count(std::span<const Regions> partitions) {
  return cell_count(planes_of(partitions)) * partitions.size();
}

JointLattice::JointLattice(std::span<const Regions> partitions) : partition_count_(partitions.size()) {
  core::expect(!partitions.empty() && partitions.size() <= partitions_max, "a lattice is of 1 to 64 partitions");
  core::expect(std::all_of(partitions.begin(), partitions.end(),
                           [&](const Regions& partition) { return partition.grid_size() == partitions[0].grid_size(); }),
               "the partitions of a lattice share out one grid");
  planes_ = planes_of(partitions);
  stride_ = {1, planes_[0].size() - 1, (planes_[0].size() - 1) * (planes_[1].size() - 1)};
  owners_.reserve(cell_count(planes_) * partition_count_);
  occupied_.reserve(cell_count(planes_));
  Place place;
  for (place[2] = 0; place[2] + 1 < planes_[2].size(); ++place[2]) {
    for (place[1] = 0; place[1] + 1 < planes_[1].size(); ++place[1]) {
      for (place[0] = 0; place[0] + 1 < planes_[0].size(); ++place[0]) {
        add_cell(partitions, place);
      }
    }
  }
}

/// No cut goes through a cell, so its lowest finest cell represents all of it.
void JointLattice::add_cell(std::span<const Regions> partitions, const Place& place) {
  const core::Corner lowest = {planes_[0][place[0]], planes_[1][place[1]], planes_[2][place[2]]};
  std::uint64_t occupied = 0;
  for (std::size_t i = 0; i < partitions.size(); ++i) {
    owners_.push_back(static_cast<std::uint16_t>(nodes::index_of(partitions[i].owner_of(lowest))));
    occupied |= std::uint64_t{partitions[i].is_empty(partitions[i].region_index_of(lowest)) ? 0U : 1U} << i;
  }
  occupied_.push_back(occupied);
}

}  // namespace dmpc::dataflow

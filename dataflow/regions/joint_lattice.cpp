#include "dataflow/regions/joint_lattice.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::dataflow {
namespace {

using Planes = std::array<std::vector<std::int32_t>, 3>;

/// Of the grid's ends and of all cuts between them.
Planes planes_of(std::span<const Bsp> bsps) {
  const core::Corner& size = bsps.front().grid_size();
  Planes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = {0, size[axis]};
  }
  for (const Bsp& bsp : bsps) {
    for (std::uint32_t index = 0; index + 1 < bsp.region_count(); ++index) {
      const Bsp::Cut& cut = bsp.cut_after(index);
      const auto axis = static_cast<std::size_t>(cut.axis);
      if (cut.at > 0 && cut.at < size[axis]) {
        planes[axis].push_back(cut.at);
      }
    }
  }
  for (std::vector<std::int32_t>& along : planes) {
    std::sort(along.begin(), along.end());
    along.erase(std::unique(along.begin(), along.end()), along.end());
  }
  return planes;
}

std::size_t cell_count(const Planes& planes) { return (planes[0].size() - 1) * (planes[1].size() - 1) * (planes[2].size() - 1); }

}  // namespace

std::size_t JointLattice::owner_count(std::span<const Bsp> bsps) { return cell_count(planes_of(bsps)) * bsps.size(); }

JointLattice::JointLattice(std::span<const Bsp> bsps) : bsp_count_(bsps.size()) {
  core::expect(!bsps.empty() && bsps.size() <= bsps_max, "a lattice is of 1 to 64 Bsps");
  core::expect(std::all_of(bsps.begin(), bsps.end(), [&](const Bsp& bsp) { return bsp.grid_size() == bsps[0].grid_size(); }),
               "the Bsps of a lattice share out one grid");
  planes_ = planes_of(bsps);
  stride_ = {1, planes_[0].size() - 1, (planes_[0].size() - 1) * (planes_[1].size() - 1)};
  owners_.reserve(cell_count(planes_) * bsp_count_);
  occupied_.reserve(cell_count(planes_));
  Place place;
  for (place[2] = 0; place[2] + 1 < planes_[2].size(); ++place[2]) {
    for (place[1] = 0; place[1] + 1 < planes_[1].size(); ++place[1]) {
      for (place[0] = 0; place[0] + 1 < planes_[0].size(); ++place[0]) {
        add_cell(bsps, place);
      }
    }
  }
}

/// No cut goes through a cell, so its lowest finest cell speaks for all of it.
void JointLattice::add_cell(std::span<const Bsp> bsps, const Place& place) {
  const core::Corner lowest = {planes_[0][place[0]], planes_[1][place[1]], planes_[2][place[2]]};
  std::uint64_t occupied = 0;
  for (std::size_t i = 0; i < bsps.size(); ++i) {
    owners_.push_back(static_cast<std::uint16_t>(nodes::index_of(bsps[i].owner_of(lowest))));
    occupied |= std::uint64_t{bsps[i].is_empty(bsps[i].region_index_of(lowest)) ? 0U : 1U} << i;
  }
  occupied_.push_back(occupied);
}

}  // namespace dmpc::dataflow

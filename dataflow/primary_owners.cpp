#include "dataflow/primary_owners.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace dmpc::dataflow {

SkyOwners::SkyOwners(const Bsp& bsp, std::uint32_t pixel_count) : pixel_count_(pixel_count) {
  std::vector<std::uint16_t> all;
  for (std::uint32_t node = 0; node < bsp.region_count(); ++node) {
    all.push_back(static_cast<std::uint16_t>(node));
    if (!bsp.is_empty(bsp.region_index_of(nodes::NodeId{node}))) {
      nodes_.push_back(static_cast<std::uint16_t>(node));
    }
  }
  nodes_ = nodes_.empty() ? all : nodes_;
}

void SkyOwners::take(std::uint32_t pixel) {
  const std::uint64_t place = std::uint64_t{pixel} * nodes_.size() / pixel_count_;
  owner_ = nodes_[place];
  end_ = static_cast<std::uint32_t>(core::ceil_divide((place + 1) * pixel_count_, std::uint64_t{nodes_.size()}));
}

PrimaryOwners::PrimaryOwners(const core::RenderSettings& settings, std::span<const Bsp> bsps)
    : settings_(settings), lattice_(bsps), walk_(lattice_, settings.header.frame), owners_(bsps.size()) {
  for (const Bsp& bsp : bsps) {
    sky_.emplace_back(bsp, settings.camera.pixel_count());
  }
}

bool PrimaryOwners::find(std::uint32_t pixel, std::uint32_t sample) {
  if (settings_.shows_background(pixel) || !walk_.enter(settings_.camera.primary_ray(pixel, sample))) {
    if (before_ == in_the_sky && pixel < sky_end_) {
      return false;
    }
    take_sky(lattice_.all_bsps(), pixel);
    before_ = in_the_sky;
    return true;
  }
  if (walk_.cell() == before_) {
    return false;
  }
  before_ = lattice_.occupied(walk_.cell()) == lattice_.all_bsps() ? walk_.cell() : on_the_way;
  take_sky(follow(), pixel);
  return true;
}

/// Gives each Bsp the owner of the first cell that is occupied there; returns those Bsps for which there is none.
std::uint64_t PrimaryOwners::follow() {
  std::uint64_t left = lattice_.all_bsps();
  do {
    const std::size_t cell = walk_.cell();
    const std::span<const std::uint16_t> owners = lattice_.owners(cell);
    for (std::uint64_t found = left & lattice_.occupied(cell); found != 0; found &= found - 1) {
      const auto bsp = static_cast<std::size_t>(std::countr_zero(found));
      owners_[bsp] = owners[bsp];
    }
    left &= ~lattice_.occupied(cell);
  } while (left != 0 && walk_.advance());
  return left;
}

void PrimaryOwners::take_sky(std::uint64_t bsps, std::uint32_t pixel) {
  sky_end_ = std::numeric_limits<std::uint32_t>::max();
  for (; bsps != 0; bsps &= bsps - 1) {
    const auto bsp = static_cast<std::size_t>(std::countr_zero(bsps));
    owners_[bsp] = sky_[bsp].owner_of(pixel);
    sky_end_ = std::min(sky_end_, sky_[bsp].end());
  }
}

}  // namespace dmpc::dataflow

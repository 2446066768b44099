#include "dataflow/primary_owners.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

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

std::uint64_t PrimaryOwners::find(std::uint32_t pixel, std::uint32_t sample) {
  const bool was_sky = is_sky_;
  is_sky_ = settings_.shows_background(pixel) || !walk_.enter(settings_.camera.primary_ray(pixel, sample));
  if (!is_sky_) {
    return follow(pixel);
  }
  deciding_count_ = 0;
  return was_sky && pixel < sky_end_ ? 0 : take_sky(lattice_.all_bsps(), pixel);
}

/// Gives each Bsp the owner of the first cell on the way that is occupied there, or that of the sky. Returns those that change.
std::uint64_t PrimaryOwners::follow(std::uint32_t pixel) {
  std::uint64_t left = lattice_.all_bsps(), changed = 0;
  std::size_t count = 0;
  bool is_as_before = true;  // the cells that decide are those that did for the ray before, and so are the owners
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
  return changed | take_sky(left, pixel);
}

std::uint64_t PrimaryOwners::take_cell(std::uint64_t bsps, std::size_t cell) {
  const std::span<const std::uint16_t> owners = lattice_.owners(cell);
  std::uint64_t changed = 0;
  for (; bsps != 0; bsps &= bsps - 1) {
    const auto bsp = static_cast<std::size_t>(std::countr_zero(bsps));
    changed |= take(bsp, owners[bsp]);
  }
  return changed;
}

std::uint64_t PrimaryOwners::take_sky(std::uint64_t bsps, std::uint32_t pixel) {
  std::uint64_t changed = 0;
  sky_end_ = std::numeric_limits<std::uint32_t>::max();
  for (; bsps != 0; bsps &= bsps - 1) {
    const auto bsp = static_cast<std::size_t>(std::countr_zero(bsps));
    changed |= take(bsp, sky_[bsp].owner_of(pixel));
    sky_end_ = std::min(sky_end_, sky_[bsp].end());
  }
  return changed;
}

/// The Bsp's bit if that changes its owner.
std::uint64_t PrimaryOwners::take(std::size_t bsp, std::uint16_t owner) {
  const bool is_other = std::exchange(owners_[bsp], owner) != owner;
  return std::uint64_t{is_other ? 1U : 0U} << bsp;
}

}  // namespace dmpc::dataflow

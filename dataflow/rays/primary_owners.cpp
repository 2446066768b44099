#include "dataflow/rays/primary_owners.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace dmpc::dataflow {

SkyOwners::SkyOwners(const Regions& partition, std::uint32_t pixel_count) : pixel_count_(pixel_count) {
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

void SkyOwners::take(std::uint32_t place) {
  const std::uint64_t share = std::uint64_t{place} * nodes_.size() / pixel_count_;
  owner_ = nodes_[share];
  end_ = static_cast<std::uint32_t>(core::ceil_divide((share + 1) * pixel_count_, std::uint64_t{nodes_.size()}));
}

PrimaryOwners::PrimaryOwners(const core::RenderSettings& settings, std::span<const Regions> partitions)
    : settings_(settings), lattice_(partitions), walk_(lattice_, settings.header.frame), owners_(partitions.size()) {
  for (const Regions& partition : partitions) {
    sky_.emplace_back(partition, settings.camera.pixel_count());
  }
}

std::uint64_t PrimaryOwners::find(std::uint32_t place, std::uint32_t pixel, std::uint32_t sample) {
  const bool was_sky = is_sky_;
  is_sky_ = settings_.shows_background(pixel) || !walk_.enter(settings_.camera.primary_ray(pixel, sample));
  if (!is_sky_) {
    return follow(place);
  }
  deciding_count_ = 0;
  return was_sky && place < sky_end_ ? 0 : take_sky(lattice_.all_partitions(), place);
}

/// Gives each partition the owner of the first cell on the way that is occupied there, or that of the sky. Returns those that
/// change.
std::uint64_t PrimaryOwners::follow(std::uint32_t place) {
  std::uint64_t left = lattice_.all_partitions(), changed = 0;
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
  return changed | take_sky(left, place);
}

std::uint64_t PrimaryOwners::take_cell(std::uint64_t partitions, std::size_t cell) {
  const std::span<const std::uint16_t> owners = lattice_.owners(cell);
  std::uint64_t changed = 0;
  for (; partitions != 0; partitions &= partitions - 1) {
    const auto partition = static_cast<std::size_t>(std::countr_zero(partitions));
    changed |= take(partition, owners[partition]);
  }
  return changed;
}

std::uint64_t PrimaryOwners::take_sky(std::uint64_t partitions, std::uint32_t place) {
  std::uint64_t changed = 0;
  sky_end_ = std::numeric_limits<std::uint32_t>::max();
  for (; partitions != 0; partitions &= partitions - 1) {
    const auto partition = static_cast<std::size_t>(std::countr_zero(partitions));
    changed |= take(partition, sky_[partition].owner_of(place));
    sky_end_ = std::min(sky_end_, sky_[partition].end());
  }
  return changed;
}

/// The partition's bit if that changes its owner.
std::uint64_t PrimaryOwners::take(std::size_t partition, std::uint16_t owner) {
  const bool is_other = std::exchange(owners_[partition], owner) != owner;
  return std::uint64_t{is_other ? 1U : 0U} << partition;
}

}  // namespace dmpc::dataflow

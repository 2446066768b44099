#include "dataflow/rays/primaries.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/expect.h"
#include "dataflow/rays/primary_owners.h"

namespace dmpc::dataflow {
namespace {

constexpr std::uint32_t nobody = ~std::uint32_t{0};

/// Iterates over the rays of a pass. Calls begin(partition, node, number) where a partition's run of consecutive rays of one node
/// begins, with `nobody` for unassigned rays and, at the end, after the last ray.
template <class Begin>
void assign(const core::RenderSettings& settings, std::span<const Regions> partitions, const core::Pass& pass,
            const core::PixelMask& done, const std::stop_token& stop, const PixelOrder& order, const Begin& begin) {
  PrimaryOwners owners(settings, partitions);
  const auto begin_each = [&](std::uint64_t those, std::uint64_t number, bool is_assigned) {
    for (; those != 0; those &= those - 1) {
      const auto partition = static_cast<std::size_t>(std::countr_zero(those));
      begin(partition, is_assigned ? owners.owners()[partition] : nobody, number);
    }
  };
  const core::SampleRange numbered = numbered_samples(pass);
  std::uint64_t end = 0;    // after the previous ray
  bool follows_on = false;  // whether an assigned run is open
  for (std::uint32_t place = 0; place < settings.camera.pixel_count() && !stop.stop_requested(); ++place) {
    const std::uint32_t pixel = order.pixel_at(place);
    if (done.has(pixel) || !pass.has(pixel)) {
      continue;
    }
    const core::SampleRange samples = pass.samples(pixel);
    std::uint64_t number = std::uint64_t{place} * numbered.count + samples.first;
    if (follows_on && number != end) {
      begin_each(owners.all_partitions(), end, false);
      follows_on = false;
    }
    for (std::uint32_t i = 0; i < samples.count; ++i, ++number) {
      const std::uint64_t changed = owners.find(place, pixel, samples.first + i);
      begin_each(follows_on ? changed : owners.all_partitions(), number, true);
      follows_on = true;
    }
    end = number;
  }
  begin_each(follows_on ? owners.all_partitions() : 0, end, false);
}

/// The number of the first `partitions` that share a lattice. Cuts that do not continue each other create many cells.
std::size_t joint_count(std::span<const Regions> partitions) {
  constexpr std::size_t owners_max = std::size_t{1} << 21U;
  std::size_t count = 1;
  while (count < std::min(partitions.size(), JointLattice::partitions_max) &&
         JointLattice::owner_count(partitions.first(count + 1)) <= owners_max) {
    ++count;
  }
  return count;
}

}  // namespace

std::vector<std::vector<PrimaryRun>> assign_primaries(const core::RenderSettings& settings, const Regions& partition,
                                                      const core::Pass& pass, const core::PixelMask& done,
                                                      const std::stop_token& stop, const PixelOrder& order) {
  std::vector<std::vector<PrimaryRun>> runs(partition.node_count());
  PrimaryRun* before = nullptr;
  assign(settings, std::span(&partition, 1), pass, done, stop, order, [&](std::size_t, std::uint32_t node, std::uint64_t number) {
    if (before != nullptr) {
      before->count = number - before->first;
    }
    before = node == nobody ? nullptr : &runs[node].emplace_back(PrimaryRun{.first = number});
  });
  return runs;
}

std::vector<std::vector<std::size_t>> count_primary_runs(const core::RenderSettings& settings,
                                                         std::span<const Regions> partitions, const core::Pass& pass,
                                                         const core::PixelMask& done, const std::stop_token& stop,
                                                         const PixelOrder& order) {
  std::vector<std::vector<std::size_t>> counts;
  while (counts.size() < partitions.size()) {
    const std::size_t first = counts.size();
    const std::span<const Regions> left = partitions.subspan(first), joint = left.first(joint_count(left));
    for (const Regions& partition : joint) {
      counts.emplace_back(partition.node_count());
    }
    assign(settings, joint, pass, done, stop, order, [&](std::size_t partition, std::uint32_t node, std::uint64_t) {
      if (node != nobody) {
        ++counts[first + partition][node];
      }
    });
  }
  return counts;
}

nodes::Room<PrimaryRun> Primaries::layout(std::size_t run_count, bool is_assigned) {
  return {nodes::Category::queues,
          std::max(run_count, is_assigned ? assigned_packets * std::tuple_size_v<decltype(AssignedPrimaries::runs)> : 0)};
}

Primaries::Primaries(nodes::LocalMemory& memory, std::span<const PrimaryRun> runs, const core::SampleRange& samples,
                     bool is_assigned)
    : runs_(layout(runs.size(), is_assigned).in(memory)), count_(runs.size()), samples_(samples) {
  std::copy(runs.begin(), runs.end(), runs_.begin());
  for (const PrimaryRun& run : runs) {
    left_ += run.count;
  }
}

std::uint64_t Primaries::take() {
  core::expect(left_ > 0, "a primary ray starts once");
  --left_;
  const PrimaryRun& run = runs_[first_];
  const std::uint64_t number = run.first + started_of_run_;
  if (++started_of_run_ == run.count) {
    first_ = (first_ + 1) % runs_.size();
    --count_;
    started_of_run_ = 0;
  }
  return number;
}

void Primaries::put(const AssignedPrimaries& assigned) {
  core::expect(assigned.count <= assigned.runs.size() && count_ + assigned.count <= runs_.size(), "assigned rays come by credit");
  core::expect(empty() || assigned.samples == samples_, "a pass begins when the one before has ended");
  samples_ = assigned.samples;
  ++packets_;
  for (std::uint32_t i = 0; i < assigned.count; ++i) {
    runs_[(first_ + count_) % runs_.size()] = assigned.runs[i];
    ++count_;
    left_ += assigned.runs[i].count;
  }
}

std::uint32_t Primaries::packets_worked_off() {
  const std::size_t room = AssignedPrimaries().runs.size();
  const auto kept = static_cast<std::uint32_t>((count_ + room - 1) / room);
  return packets_ > kept ? std::exchange(packets_, kept) - kept : 0;
}

}  // namespace dmpc::dataflow

#include "dataflow/primaries.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/expect.h"
#include "core/trace/traversal.h"
#include "dataflow/next_stop.h"

namespace dmpc::dataflow {
namespace {

/// The nodes that share the sky: all but those whose region holds nothing, unless that is all.
std::vector<std::uint32_t> sky_nodes(const Bsp& bsp) {
  std::vector<std::uint32_t> all, occupied;
  for (std::uint32_t node = 0; node < bsp.region_count(); ++node) {
    all.push_back(node);
    if (!bsp.is_empty(bsp.region_index_of(nodes::NodeId{node}))) {
      occupied.push_back(node);
    }
  }
  return occupied.empty() ? all : occupied;
}

/// Finds whose a primary ray is.
class Dealer {
 public:
  Dealer(const core::RenderSettings& settings, const Bsp& bsp) : settings_(settings), bsp_(bsp), sky_nodes_(sky_nodes(bsp)) {}

  std::uint32_t node_of(std::uint32_t pixel, std::uint32_t sample) {
    const auto region_owner = settings_.shows_background(pixel) ? std::nullopt : first_owner(pixel, sample);
    return region_owner.value_or(sky_nodes_[std::uint64_t{pixel} * sky_nodes_.size() / settings_.camera.pixel_count()]);
  }

 private:
  /// Of the regions on the ray's way that hold something.
  std::optional<std::uint32_t> first_owner(std::uint32_t pixel, std::uint32_t sample) {
    const core::GridFrame& frame = settings_.header.frame;
    const core::Ray ray = settings_.camera.primary_ray(pixel, sample);
    if (const auto passage = core::first_passage(ray, frame)) {
      const NextStop stop = next_stop(ray, *passage, frame, bsp_, operations_);
      if (stop.traced == core::Traced::left) {
        return nodes::index_of(bsp_.owner_of(stop.passage.cell));
      }
    }
    return std::nullopt;
  }

  const core::RenderSettings& settings_;
  const Bsp& bsp_;
  std::vector<std::uint32_t> sky_nodes_;
  core::Operations operations_;  // nobody's: dealing is the host's, which the model does not charge
};

}  // namespace

std::vector<std::vector<PrimaryRun>> deal_primaries(const core::RenderSettings& settings, const Bsp& bsp,
                                                    const core::SampleRange& samples, const core::PixelMask& pixels,
                                                    const std::stop_token& stop) {
  std::vector<std::vector<PrimaryRun>> runs(bsp.region_count());
  Dealer dealer(settings, bsp);
  for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count() && !stop.stop_requested(); ++pixel) {
    for (std::uint32_t i = 0; i < samples.count && pixels.has(pixel); ++i) {
      const std::uint64_t number = std::uint64_t{pixel} * samples.count + i;
      std::vector<PrimaryRun>& of_node = runs[dealer.node_of(pixel, samples.first + i)];
      if (!of_node.empty() && of_node.back().first + of_node.back().count == number) {
        ++of_node.back().count;
      } else {
        of_node.push_back({number, 1});
      }
    }
  }
  return runs;
}

std::size_t Primaries::capacity(std::size_t run_count, bool is_dealt) {
  return std::max(run_count, is_dealt ? dealt_packets * std::tuple_size_v<decltype(DealtPrimaries::runs)> : 0);
}

Primaries::Primaries(nodes::LocalMemory& memory, std::span<const PrimaryRun> runs, const core::SampleRange& samples,
                     bool is_dealt)
    : runs_(memory.allocate<PrimaryRun>(nodes::Category::queues, capacity(runs.size(), is_dealt))),
      count_(runs.size()),
      samples_(samples) {
  std::copy(runs.begin(), runs.end(), runs_.begin());
  for (const PrimaryRun& run : runs) {
    left_ += run.count;
  }
}

void Primaries::add_needs(nodes::MemoryPlan& plan, std::size_t run_count, bool is_dealt) {
  plan[nodes::Category::queues] += nodes::LocalMemory::bytes_for<PrimaryRun>(capacity(run_count, is_dealt));
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

void Primaries::put(const DealtPrimaries& dealt) {
  core::expect(dealt.count <= dealt.runs.size() && count_ + dealt.count <= runs_.size(), "dealt rays come by credit");
  core::expect(empty() || dealt.samples == samples_, "a pass begins when the one before has ended");
  samples_ = dealt.samples;
  ++packets_;
  for (std::uint32_t i = 0; i < dealt.count; ++i) {
    runs_[(first_ + count_) % runs_.size()] = dealt.runs[i];
    ++count_;
    left_ += dealt.runs[i].count;
  }
}

std::uint32_t Primaries::packets_worked_off() {
  const std::size_t room = DealtPrimaries().runs.size();
  const auto kept = static_cast<std::uint32_t>((count_ + room - 1) / room);
  return packets_ > kept ? std::exchange(packets_, kept) - kept : 0;
}

}  // namespace dmpc::dataflow

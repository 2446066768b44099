#include "dataflow/primaries.h"

#include "core/traversal.h"
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
  Dealer(const core::Camera& camera, const core::GridFrame& frame, const Bsp& bsp)
      : camera_(camera), frame_(frame), bsp_(bsp), sky_nodes_(sky_nodes(bsp)) {}

  std::uint32_t node_of(std::uint32_t pixel, std::uint32_t sample) {
    const core::Ray ray = camera_.primary_ray(pixel, sample);
    if (const auto passage = core::first_passage(ray, frame_)) {
      const NextStop stop = next_stop(ray, *passage, frame_, bsp_, operations_);
      if (stop.traced == core::Traced::left) {
        return nodes::index_of(bsp_.owner_of(stop.passage.cell));
      }
    }
    return sky_nodes_[std::uint64_t{pixel} * sky_nodes_.size() / camera_.pixel_count()];
  }

 private:
  const core::Camera& camera_;
  const core::GridFrame& frame_;
  const Bsp& bsp_;
  std::vector<std::uint32_t> sky_nodes_;
  core::Operations operations_;  // nobody's: the host deals before the clock starts
};

}  // namespace

std::vector<std::vector<PrimaryRun>> deal_primaries(const core::Camera& camera, const core::GridFrame& frame, const Bsp& bsp,
                                                    const std::stop_token& stop) {
  const auto samples = static_cast<std::uint32_t>(camera.samples());
  std::vector<std::vector<PrimaryRun>> runs(bsp.region_count());
  Dealer dealer(camera, frame, bsp);
  for (std::uint64_t number = 0; number < std::uint64_t{camera.pixel_count()} * samples && !stop.stop_requested(); ++number) {
    std::vector<PrimaryRun>& of_node =
        runs[dealer.node_of(static_cast<std::uint32_t>(number / samples), static_cast<std::uint32_t>(number % samples))];
    if (!of_node.empty() && of_node.back().first + of_node.back().count == number) {
      ++of_node.back().count;
    } else {
      of_node.push_back({number, 1});
    }
  }
  return runs;
}

}  // namespace dmpc::dataflow

#include "dataflow/primaries.h"

#include "core/traversal.h"

namespace dmpc::dataflow {
namespace {

/// Whose share of the picture a pixel is.
std::uint32_t node_of_pixel(std::uint32_t pixel, std::uint32_t pixel_count, std::uint32_t node_count) {
  return static_cast<std::uint32_t>(std::uint64_t{pixel} * node_count / pixel_count);
}

}  // namespace

std::vector<std::vector<PrimaryRun>> deal_primaries(const core::Camera& camera, const core::GridFrame& frame, const Bsp& bsp) {
  const std::uint32_t node_count = bsp.region_count();
  const auto samples = static_cast<std::uint32_t>(camera.samples());
  std::vector<std::vector<PrimaryRun>> runs(node_count);
  for (std::uint64_t number = 0; number < std::uint64_t{camera.pixel_count()} * samples; ++number) {
    const auto pixel = static_cast<std::uint32_t>(number / samples);
    const auto passage = core::first_passage(camera.primary_ray(pixel, static_cast<std::uint32_t>(number % samples)), frame);
    const std::uint32_t node =
        passage ? nodes::index_of(bsp.owner_of(passage->cell)) : node_of_pixel(pixel, camera.pixel_count(), node_count);
    std::vector<PrimaryRun>& of_node = runs[node];
    if (!of_node.empty() && of_node.back().first + of_node.back().count == number) {
      ++of_node.back().count;
    } else {
      of_node.push_back({number, 1});
    }
  }
  return runs;
}

}  // namespace dmpc::dataflow

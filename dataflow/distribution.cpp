#include "dataflow/distribution.h"

namespace dmpc::dataflow {
namespace {

/// More nodes than this are not tried for a memory that is too small: the database is cut up anew for each.
constexpr std::uint32_t node_count_tried_max = 256;

bool fits(PlanRequest& request, std::uint32_t node_count, const MakeShares& make_shares) {
  request.shares = make_shares(node_count);
  return smallest_node_memory_bytes(request) <= *request.computer.node_memory_bytes;
}

}  // namespace

std::vector<Share> Distribution::shares() const {
  std::vector<Share> shares;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shares.push_back({parts[i].record_bytes, primaries[i].size()});
  }
  return shares;
}

double Distribution::duplication(const core::Database& database) const {
  std::uint64_t copies = 0;
  for (const core::DatabasePart& part : parts) {
    copies += part.primitive_copies;
  }
  return database.references() == 0 ? 1.0 : static_cast<double>(copies) / static_cast<double>(database.references());
}

Distribution distribute(const core::Database& database, const core::RenderSettings& settings, const Bsp& bsp,
                        const std::stop_token& stop, const Dealing& dealing) {
  Distribution distribution{bsp, {}, {}};
  for (std::uint32_t node = 0; node < bsp.region_count(); ++node) {
    distribution.parts.push_back(core::extract(database, bsp.region_of(nodes::NodeId{node})));
    if (!dealing.records) {
      core::forget(distribution.parts.back().bytes);
    }
    if (settings.skips.empty_regions && distribution.parts.back().primitive_copies == 0) {
      distribution.bsp.mark_empty(bsp.region_index_of(nodes::NodeId{node}));
    }
  }
  distribution.primaries = deal_primaries(settings, distribution.bsp, settings.first_samples(),
                                          core::PixelMask(settings.camera.pixel_count(), dealing.primaries), stop);
  return distribution;
}

std::optional<std::uint32_t> smallest_node_count(PlanRequest request, const MakeShares& make_shares) {
  std::uint32_t too_few = request.node_count(), enough = 2 * too_few;
  while (enough <= node_count_tried_max && !fits(request, enough, make_shares)) {
    too_few = enough;
    enough *= 2;
  }
  if (enough > node_count_tried_max) {
    return std::nullopt;
  }
  while (enough - too_few > 1) {
    const std::uint32_t middle = too_few + (enough - too_few) / 2;
    (fits(request, middle, make_shares) ? enough : too_few) = middle;
  }
  return enough;
}

}  // namespace dmpc::dataflow

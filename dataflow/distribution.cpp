#include "dataflow/distribution.h"

namespace dmpc::dataflow {
namespace {

/// More nodes than this are not tried for a memory that is too small: the database is cut up anew for each.
constexpr std::uint32_t node_count_tried_max = 256;

bool fits(PlanRequest& request, std::uint32_t node_count, const MakeShares& make_shares) {
  request.shares = make_shares(node_count);
  return !request.shares.empty() && smallest_node_memory_bytes(request) <= *request.computer.node_memory_bytes;
}

std::vector<core::Region> boxes_of(const Regions& regions, const std::vector<std::uint32_t>& indices) {
  std::vector<core::Region> boxes;
  for (const std::uint32_t index : indices) {
    boxes.push_back(regions.region_at(index));
  }
  return boxes;
}

/// Rays need not go to the owner of a region that holds nothing. `part` is that of the regions with these numbers.
void mark_empty(Regions& regions, const std::vector<std::uint32_t>& indices, const core::DatabasePart& part,
                const core::RenderSettings& settings) {
  for (std::size_t i = 0; settings.skips.empty_regions && i < indices.size(); ++i) {
    if (!part.holds[i]) {
      regions.mark_empty(indices[i]);
    }
  }
}

core::DatabasePart outline_for(const core::Database& database, const core::RenderSettings& settings) {
  return core::outline_of(database, settings.skips.empty_regions ? core::outline_bytes_max(database) : 0);
}

double duplication_of(std::uint64_t copies, const core::Database& database) {
  return database.references() == 0 ? 1.0 : static_cast<double>(copies) / static_cast<double>(database.references());
}

}  // namespace

std::vector<Share> Distribution::shares() const {
  std::vector<Share> shares;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shares.push_back({parts[i].record_bytes, primaries[i].size(), outline.bytes.size()});
  }
  return shares;
}

double Distribution::duplication(const core::Database& database) const {
  std::uint64_t copies = 0;
  for (const core::DatabasePart& part : parts) {
    copies += part.primitive_copies;
  }
  return duplication_of(copies, database);
}

Distribution distribute(const core::Database& database, const core::RenderSettings& settings, const Regions& regions,
                        const std::stop_token& stop, bool deals_primaries) {
  Distribution distribution{regions, {}, {}, outline_for(database, settings)};
  for (const std::vector<std::uint32_t>& indices : regions.by_node()) {
    distribution.parts.push_back(core::extract(database, boxes_of(regions, indices)));
    mark_empty(distribution.regions, indices, distribution.parts.back(), settings);
  }
  distribution.primaries = deal_primaries(settings, distribution.regions, settings.first_pass(),
                                          core::PixelMask(settings.camera.pixel_count(), !deals_primaries), stop);
  return distribution;
}

MeasuredParts measure_parts(const core::Database& database, const core::RenderSettings& settings, Regions& regions) {
  MeasuredParts parts;
  std::uint64_t copies = 0;
  for (const std::vector<std::uint32_t>& indices : regions.by_node()) {
    const core::DatabasePart part = core::measure_part(database, boxes_of(regions, indices));
    mark_empty(regions, indices, part, settings);
    parts.record_bytes.push_back(part.record_bytes);
    copies += part.primitive_copies;
  }
  parts.duplication = duplication_of(copies, database);
  parts.outline_bytes = outline_for(database, settings).bytes.size();
  return parts;
}

std::vector<std::vector<Share>> measure_shares(const core::RenderSettings& settings, std::span<const Regions> partitions,
                                               std::span<const MeasuredParts> parts, const std::stop_token& stop,
                                               bool deals_primaries) {
  const auto runs = count_primary_runs(settings, partitions, settings.first_pass(),
                                       core::PixelMask(settings.camera.pixel_count(), !deals_primaries), stop);
  std::vector<std::vector<Share>> shares(partitions.size());
  for (std::size_t i = 0; i < partitions.size(); ++i) {
    for (std::uint32_t node = 0; node < partitions[i].node_count(); ++node) {
      shares[i].push_back({parts[i].record_bytes[node], runs[i][node], parts[i].outline_bytes});
    }
  }
  return shares;
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

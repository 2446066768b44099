#include "dataflow/distribution.h"

#include <utility>

#include "dataflow/units/unit_pages.h"

namespace dmpc::dataflow {
namespace {

/// Larger node counts are not tried when the memory is too small: the database is divided anew for each.
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

/// Marks regions that hold nothing, whose owners rays need not visit. `part` is that of the regions with these numbers.
void mark_empty(Regions& regions, const std::vector<std::uint32_t>& indices, const core::DatabasePart& part,
                const core::RenderSettings& settings) {
  for (std::size_t i = 0; settings.skips.empty_regions && i < indices.size(); ++i) {
    if (!part.holds[i]) {
      regions.mark_empty(indices[i]);
    }
  }
}

/// The pages of the whole database instead of a new part: addresses are then the same on every node.
core::DatabasePart part_in_pages(const core::Database& database, const std::vector<core::Region>& regions,
                                 const std::vector<std::uint32_t>& pages, bool keeps_bytes) {
  core::DatabasePart part = core::measure_part(database, regions);
  part.header = database.header();
  part.header.region = regions.front();
  part.record_bytes = pages.size() * database.page_size();
  for (std::size_t i = 0; keeps_bytes && i < pages.size(); ++i) {
    const std::span<const std::byte> page = database.page(pages[i]);
    part.bytes.insert(part.bytes.end(), page.begin(), page.end());
  }
  return part;
}

/// Gives each node the runs of its units; `runs` are sorted by unit.
void assign_by_unit(Distribution& distribution, const std::vector<std::vector<PrimaryRun>>& runs) {
  const std::uint32_t node_count = distribution.regions.node_count();
  distribution.primaries.resize(node_count);
  distribution.runs_of_unit.resize(node_count, std::vector<std::uint32_t>(runs.size()));
  for (std::uint32_t unit = 0; unit < runs.size(); ++unit) {
    const std::uint32_t node = nodes::index_of(distribution.regions.owner_at(unit));
    std::vector<PrimaryRun>& its = distribution.primaries[node];
    its.insert(its.end(), runs[unit].begin(), runs[unit].end());
    distribution.runs_of_unit[node][unit] = static_cast<std::uint32_t>(runs[unit].size());
  }
}

/// The sum for each node over its units.
std::vector<std::size_t> by_owner(const Regions& regions, const std::vector<std::size_t>& of_unit) {
  std::vector<std::size_t> of_node(regions.node_count());
  for (std::uint32_t unit = 0; unit < of_unit.size(); ++unit) {
    of_node[nodes::index_of(regions.owner_at(unit))] += of_unit[unit];
  }
  return of_node;
}

core::DatabasePart proxy_for(const core::Database& database, const core::RenderSettings& settings) {
  return core::proxy_of(database, settings.skips.empty_regions ? core::proxy_bytes_max(database) : 0);
}

double duplication_of(std::uint64_t copies, const core::Database& database) {
  return database.references() == 0 ? 1.0 : static_cast<double>(copies) / static_cast<double>(database.references());
}

}  // namespace

std::vector<Share> Distribution::shares() const {
  std::vector<Share> shares;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shares.push_back({parts[i].record_bytes, primaries[i].size(), proxy.bytes.size(), page_bytes});
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
                        const std::stop_token& stop, bool assigns_primaries, const PixelOrder& order) {
  Distribution distribution{
      .regions = regions, .parts = {}, .primaries = {}, .pages = {}, .runs_of_unit = {}, .proxy = proxy_for(database, settings)};
  distribution.page_bytes = regions.are_moving() ? database.page_size() : 0;
  for (const std::vector<std::uint32_t>& indices : regions.by_node()) {
    const std::vector<core::Region> boxes = boxes_of(regions, indices);
    distribution.pages.push_back(regions.are_moving() ? pages_of(database, boxes) : std::vector<std::uint32_t>());
    distribution.parts.push_back(regions.are_moving() ? part_in_pages(database, boxes, distribution.pages.back(), true)
                                                      : core::extract(database, boxes));
    mark_empty(distribution.regions, indices, distribution.parts.back(), settings);
  }
  const core::PixelMask done(settings.camera.pixel_count(), !assigns_primaries);
  if (regions.are_moving()) {
    assign_by_unit(distribution,
                   assign_primaries(settings, distribution.regions.by_unit(), settings.first_pass(), done, stop, order));
  } else {
    distribution.primaries = assign_primaries(settings, distribution.regions, settings.first_pass(), done, stop, order);
    distribution.runs_of_unit.resize(regions.node_count());
  }
  return distribution;
}

MeasuredParts measure_parts(const core::Database& database, const core::RenderSettings& settings, Regions& regions) {
  MeasuredParts parts;
  std::uint64_t copies = 0;
  for (const std::vector<std::uint32_t>& indices : regions.by_node()) {
    const std::vector<core::Region> boxes = boxes_of(regions, indices);
    const core::DatabasePart part = regions.are_moving() ? part_in_pages(database, boxes, pages_of(database, boxes), false)
                                                         : core::measure_part(database, boxes);
    mark_empty(regions, indices, part, settings);
    parts.record_bytes.push_back(part.record_bytes);
    copies += part.primitive_copies;
  }
  parts.page_bytes = regions.are_moving() ? database.page_size() : 0;
  parts.duplication = duplication_of(copies, database);
  parts.proxy_bytes = proxy_for(database, settings).bytes.size();
  return parts;
}

std::vector<std::vector<Share>> measure_shares(const core::RenderSettings& settings, std::span<const Regions> partitions,
                                               std::span<const MeasuredParts> parts, const std::stop_token& stop,
                                               bool assigns_primaries, const PixelOrder& order) {
  std::vector<Regions> assigned;
  for (const Regions& partition : partitions) {
    assigned.push_back(partition.are_moving() ? partition.by_unit() : partition);
  }
  auto runs = count_primary_runs(settings, assigned, settings.first_pass(),
                                 core::PixelMask(settings.camera.pixel_count(), !assigns_primaries), stop, order);
  std::vector<std::vector<Share>> shares(partitions.size());
  for (std::size_t i = 0; i < partitions.size(); ++i) {
    runs[i] = partitions[i].are_moving() ? by_owner(partitions[i], runs[i]) : std::move(runs[i]);
    for (std::uint32_t node = 0; node < partitions[i].node_count(); ++node) {
      shares[i].push_back({parts[i].record_bytes[node], runs[i][node], parts[i].proxy_bytes, parts[i].page_bytes});
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

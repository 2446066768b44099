#include "core/picture/ray_crowd.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/record/records.h"

namespace dmpc::core {
namespace {

constexpr std::uint64_t looked_at = 64;
/// Odd and near to the fractional part of the golden ratio, so its multiples spread over the whole picture.
constexpr std::uint64_t stride = 2'654'435'761;

/// A material with an extension may transmit light: its record does not say whether it has alpha.
bool can_send_two(const MaterialRecord& material) {
  return material.has_extension() || (material.specular > 0.0F && material.transmittance > 0.0F);
}

bool can_send_one(const MaterialRecord& material) {
  return material.has_extension() || material.specular > 0.0F || material.transmittance > 0.0F;
}

bool is_for_any(const Database& database, bool (*is_meant)(const MaterialRecord&)) {
  const DatabaseHeader& header = database.header();
  const LocalRecords records(database.bytes());
  for (std::uint32_t i = 0; i < header.material_count;
       ++i) {  // extensions come last, and a material is tested before its extension
    if (is_meant(read<MaterialRecord>(records.find(advance(header.materials, i * sizeof(MaterialRecord)))))) {
      return true;
    }
  }
  return false;
}

std::uint64_t rays_in(const Operations& operations) {
  return std::accumulate(operations.rays.begin(), operations.rays.end(), std::uint64_t{0});
}

}  // namespace

std::uint8_t find_one_child_depth(const Database& database, const RenderSettings& settings) {
  if (settings.shade.depth_max <= crowd_depth || !is_for_any(database, can_send_two)) {
    return 0;
  }
  RenderSettings all = settings;
  all.skips = {};  // skipped rays change no film, so they must not change the counts either
  LocalRecords records(database.bytes());
  GridTracer tracer(records, all.header, all.skips);
  std::vector<HitState> stack(static_cast<std::size_t>(all.shade.depth_max));
  PixelTask task(stack);
  Operations operations;
  const std::uint64_t pixels = all.camera.pixel_count(), count = std::min(looked_at, pixels);
  for (std::uint64_t i = 0; i < count; ++i) {
    task.start(static_cast<std::uint32_t>(i * stride % pixels), {0, 1}, all, operations);
    while (task.run(tracer, all, operations) != TaskState::finished) {
      if (rays_in(operations) > crowd_rays * count) {
        return crowd_depth;
      }
    }
  }
  return 0;
}

bool has_reflection_or_transmission(const Database& database) { return is_for_any(database, can_send_one); }

}  // namespace dmpc::core

#include "core/database/shading/material_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "core/base/expect.h"

namespace dmpc::core {
namespace {

std::uint16_t share_of(double share) {
  return static_cast<std::uint16_t>(std::floor(std::clamp(share, 0.0, 1.0) * MaterialExtensionRecord::share_max + 0.5));
}

std::uint16_t cutoff_of(const Material& from) {
  return from.alpha == AlphaUse::cut ? std::max<std::uint16_t>(share_of(from.alpha_cutoff), 1) : std::uint16_t{0};
}

MaterialExtensionRecord extension_of(const Material& from) {
  MaterialExtensionRecord finish;
  finish.specular = Color(from.specular_color * from.specular);
  finish.emission = Color(from.emission);
  finish.refraction_index = static_cast<float>(from.refraction_index);
  finish.alpha_cutoff = cutoff_of(from);
  finish.mirror = share_of(from.mirror);
  return finish;
}

/// The MicrofacetRecord as a MaterialExtensionRecord, whose slot it takes.
MaterialExtensionRecord microfacets_of(const Material& from) {
  const Microfacets& facets = from.microfacets;
  return std::bit_cast<MaterialExtensionRecord>(
      MicrofacetRecord{.metallic = static_cast<float>(facets.metallic),
                       .alpha = static_cast<float>(facets.roughness * facets.roughness),
                       .reflectance = static_cast<float>(facets.reflectance),
                       .emission = Color(from.emission),
                       .refraction_index = static_cast<float>(from.refraction_index),
                       .alpha_cutoff = cutoff_of(from),
                       .has_texture = facets.have_texture() ? std::uint16_t{1} : std::uint16_t{0}});
}

MaterialRecord base_of(const Material& from) {
  const Microfacets& facets = from.microfacets;
  const double metallic = facets.have_texture() ? 0 : facets.metallic;
  const double dielectric = facets.opacity * (1 - metallic), through = facets.transmission;
  const double mean = (from.color.x + from.color.y + from.color.z) / 3;
  return {Color(from.color),
          static_cast<float>(dielectric * (1 - through)),
          static_cast<float>(facets.opacity),
          MaterialRecord::microfacet_mark,
          static_cast<float>(dielectric * through * mean + (1 - facets.opacity)),
          1};
}

MaterialRecord record_of(const Material& from) {
  return {Color(from.color),
          static_cast<float>(from.diffuse),
          static_cast<float>(from.specular),
          static_cast<float>(from.shine),
          static_cast<float>(from.transmittance),
          static_cast<float>(from.refraction_index)};
}

}  // namespace

MaterialRecords material_records(const std::vector<Material>& materials, bool for_paths) {
  MaterialRecords records;
  for (const Material& material : materials) {
    const bool has_microfacets = for_paths && material.microfacets.are_there();
    MaterialRecord& record = records.materials.emplace_back(has_microfacets ? base_of(material) : record_of(material));
    if (has_microfacets || material.has_extension()) {
      const std::size_t place = materials.size() + records.finishes.size();
      if (place > MaterialRecord::extension_max) {
        throw CapacityError("the scene has more than " + std::to_string(MaterialRecord::extension_max) +
                            " materials together with what only mesh files say of them; give it fewer");
      }
      record.set_extension(static_cast<std::uint32_t>(place));
      if (has_microfacets) {
        records.finishes.push_back(microfacets_of(material));
      } else {
        record.specular = static_cast<float>(material.tinted_specular);
        records.finishes.push_back(extension_of(material));
      }
    }
  }
  return records;
}

}  // namespace dmpc::core

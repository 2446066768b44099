#include "core/database/material_records.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/expect.h"

namespace dmpc::core {
namespace {

std::uint16_t share_of(double share) {
  return static_cast<std::uint16_t>(std::floor(std::clamp(share, 0.0, 1.0) * FinishRecord::share_max + 0.5));
}

FinishRecord finish_of(const Material& from) {
  FinishRecord finish;
  finish.specular = Color(from.specular_color * from.specular);
  finish.emission = Color(from.emission);
  finish.refraction_index = static_cast<float>(from.refraction_index);
  if (from.alpha == AlphaUse::cut) {
    finish.alpha_cutoff = std::max<std::uint16_t>(share_of(from.alpha_cutoff), 1);
  }
  finish.mirror = share_of(from.mirror);
  return finish;
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

MaterialRecords material_records(const std::vector<Material>& materials) {
  MaterialRecords records;
  for (const Material& material : materials) {
    MaterialRecord& record = records.materials.emplace_back(record_of(material));
    if (material.has_finish()) {
      const std::size_t place = materials.size() + records.finishes.size();
      if (place > MaterialRecord::finish_max) {
        throw RoomError("the scene has more than " + std::to_string(MaterialRecord::finish_max) +
                        " materials together with what only mesh files say of them; give it fewer");
      }
      record.specular = static_cast<float>(material.tinted_specular);
      record.set_finish(static_cast<std::uint32_t>(place));
      records.finishes.push_back(finish_of(material));
    }
  }
  return records;
}

}  // namespace dmpc::core

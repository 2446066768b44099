// The records of a scene's materials.
#pragma once

#include <cstdint>
#include <vector>

#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// One behind the other they are what DatabaseHeader::materials is the address of.
struct MaterialRecords {
  std::vector<MaterialRecord> materials;          ///< of the scene's, in order
  std::vector<MaterialExtensionRecord> finishes;  ///< of those of them that have one, in order
};

/// `for_paths`: materials that have microfacets are of those, in place of what approximates them.
/// Throws CapacityError if more have a finish than a material's record can name.
MaterialRecords material_records(const std::vector<Material>& materials, bool for_paths = false);

}  // namespace dmpc::core

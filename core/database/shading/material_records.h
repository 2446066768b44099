// The records of a scene's materials.
#pragma once

#include <cstdint>
#include <vector>

#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// One after the other they form the array at DatabaseHeader::materials.
struct MaterialRecords {
  std::vector<MaterialRecord> materials;          ///< for the scene's, in order
  std::vector<MaterialExtensionRecord> finishes;  ///< for those that have an extension, in order
};

/// `for_paths`: microfacet materials have these records, in place of their approximation. Throws CapacityError if more have an
/// extension than a material's record can name.
MaterialRecords material_records(const std::vector<Material>& materials, bool for_paths = false);

}  // namespace dmpc::core

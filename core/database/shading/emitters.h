// Selects the primitives for light sampling, and makes their records.
#pragma once

#include <cstdint>
#include <vector>

#include "core/database/conversion.h"
#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/scene/scene.h"

namespace dmpc::core {

struct Emitters {
  std::vector<EmitterRecord> records;  ///< by primitive
  std::vector<ChoiceNode> choices;     ///< by which one of `records` is selected
  std::vector<Material> materials;     ///< for these primitives, after the scene's
  float density = 0;                   ///< DatabaseHeader::emitter_density
  std::uint64_t others = 0;            ///< emitting primitives that are found by BSDF sampling alone
  std::uint64_t covered = 0;           ///< number of these that others in their plane may cover
};

/// Selects up to `count_max` triangles and spheres of the greatest power for light sampling in proportion to power, and gives
/// them materials of their own, which mark them. All others are found by BSDF sampling alone: cones, spheres seen from inside,
/// partly transparent surfaces (alpha), triangles that others may cover in their plane, and those with less than a millionth of
/// the mean power.
Emitters choose_emitters(Conversion& conversion, const Scene& scene, std::uint32_t count_max);

}  // namespace dmpc::core

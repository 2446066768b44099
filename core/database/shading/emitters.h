// Which of a scene's primitives that shine by themselves hits aim at, and their records.
#pragma once

#include <cstdint>
#include <vector>

#include "core/database/conversion.h"
#include "core/record/emitter.h"
#include "core/scene/scene.h"

namespace dmpc::core {

struct Emitters {
  std::vector<EmitterRecord> records;  ///< by primitive
  std::vector<EmitterChoice> choices;  ///< as many
  std::vector<Material> materials;     ///< theirs, which stand behind the scene's
  float density = 0;                   ///< DatabaseHeader::emitter_density
  std::uint64_t others = 0;            ///< primitives that shine and are met by chance alone
  std::uint64_t covered = 0;           ///< and what others in their plane leave of these
};

/// Chooses up to `count_max` triangles and spheres of the greatest power, each to be drawn in proportion to that, and gives them
/// materials of their own, which only say that. Met by chance alone are all others: cones, spheres seen from inside, what alpha
/// leaves a part of, triangles that others may cover in their plane, and what has less than a millionth of the mean power.
Emitters choose_emitters(Conversion& conversion, const Scene& scene, std::uint32_t count_max);

}  // namespace dmpc::core

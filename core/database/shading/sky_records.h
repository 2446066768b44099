// A sky's picture as records: its tiles, and the table for sampling one of them.
#pragma once

#include <vector>

#include "core/base/vec.h"
#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/record/record.h"
#include "core/scene/sky_texels.h"

namespace dmpc::core {

struct SkyRecords {
  SkyReference reference;           ///< without addresses
  std::vector<TextureTile> tiles;   ///< as many as `tiles`
  std::vector<ChoiceNode> choices;  ///< by which one of `tiles` is selected
};

/// For a sky that has a picture, in a grid with `middle` and `up` as in SkyReference.
SkyRecords sky_records(const SkyTexels& sky, const Vec3d& middle, const Vec3d& up);

}  // namespace dmpc::core

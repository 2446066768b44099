// A sky's picture as records: its tiles, and the table by which hits draw one of them.
#pragma once

#include <vector>

#include "core/base/vec.h"
#include "core/record/emitter.h"
#include "core/record/record.h"
#include "core/scene/sky_texels.h"

namespace dmpc::core {

struct SkyRecords {
  SkyReference reference;              ///< without addresses
  std::vector<TextureTile> tiles;      ///< row by row
  std::vector<EmitterChoice> choices;  ///< as many
};

/// Of a picture that is there, in a grid where `middle` and `up` are as SkyReference has them.
SkyRecords sky_records(const SkyTexels& sky, const Vec3d& middle, const Vec3d& up);

}  // namespace dmpc::core

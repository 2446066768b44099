// Light sampling of the plain path tracer, in single precision.
#pragma once

#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/oracle/emitter_aim.h"
#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// A point on an emitter.
struct PlainAim : EmitterAim<float> {
  core::Color radiance;
};

/// From `from`, by our records, alias table and formulas (core/picture/lights/emitter_light.h). Nothing from within a sphere, or
/// where a triangle is seen edge-on. Requires emitters.
std::optional<PlainAim> plain_aim(const PlainStage& stage, const core::Vec3f& from, const core::SamplePair& emitter,
                                  const core::SamplePair& place);

/// How densely such aim from `from` at where a ray along `direction` has met a surface of this radiance that is drawn.
float plain_bsdf_density(const PlainStage& stage, const PlainSurface& surface, const core::Vec3f& from,
                         const core::Vec3f& direction, const core::Color& radiance);

}  // namespace dmpc::apps

// Light sampling of the plain path tracer, in single precision.
#pragma once

#include <optional>

#include "apps/lab/bench/speed/plain_stage.h"
#include "apps/lab/oracle/emitter_aim.h"
#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

struct PlainAim : EmitterAim<float> {
  core::Color radiance;
};

/// Samples a point from `from` with our records, tree of choices and formulas (core/picture/lights). Returns nothing
/// from within a sphere, or where a triangle is seen edge-on. Requires emitters.
std::optional<PlainAim> plain_aim(const PlainStage& stage, const core::Vec3f& from, const core::SamplePair& emitter,
                                  const core::SamplePair& place);

/// Returns the density of light sampling from `from` at the point where a ray along `direction` has hit a surface of this
/// radiance, if it is sampled.
float plain_bsdf_density(const PlainStage& stage, const PlainSurface& surface, const core::Vec3f& from,
                         const core::Vec3f& direction, const core::Color& radiance);

}  // namespace dmpc::apps

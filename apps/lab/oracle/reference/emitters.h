// Emitters for light sampling, in double precision: the product's choice of them, and arithmetic of its own.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/oracle/emitter_aim.h"
#include "apps/lab/oracle/reference/scene.h"
#include "core/database/database.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// Has the scene aim at the emitters of `database`, which was built of the same one, as often as the product does.
void aim_as_product(ReferenceScene& scene, const core::Database& database);

/// An emitter, and a place on it, as the product's: by two pairs, of the place and of further digits. Nothing from within a
/// sphere, or where a triangle is seen edge-on. Requires that there is an emitter.
struct ReferenceTarget : EmitterAim<double> {
  std::uint32_t body;
  core::Vec3d normal;  ///< the emitter's normal there
};
std::optional<ReferenceTarget> aim_from(const ReferenceScene& scene, const core::Vec3d& from, const core::SamplePair& place,
                                        const core::SamplePair& digits);

/// How densely hits aim from there at a place of an emitter's body, per steradian.
double light_sampling_density(const ReferenceScene& scene, const ReferenceBody& body, const core::Vec3d& from,
                              const core::Vec3d& place, const core::Vec3d& normal);

}  // namespace dmpc::apps

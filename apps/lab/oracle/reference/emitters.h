// Emitters for light sampling in double precision: the product's choice of emitters, and arithmetic of its own.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/oracle/emitter_aim.h"
#include "apps/lab/oracle/reference/scene.h"
#include "core/database/database.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// Makes the scene sample the emitters of `database`, which was built from the same scene, with the product's probabilities.
void aim_as_product(ReferenceScene& scene, const core::Database& database);

/// An emitter and a point on it, chosen as by the product from two pairs: of the point, and of further digits. Nothing from
/// within a sphere, or where a triangle is seen edge-on. Requires that there is an emitter.
struct ReferenceTarget : EmitterAim<double> {
  std::uint32_t body;
  core::Vec3d normal;  ///< the emitter's normal there
};
std::optional<ReferenceTarget> aim_from(const ReferenceScene& scene, const core::Vec3d& from, const core::SamplePair& place,
                                        const core::SamplePair& digits);

/// Returns the density per steradian with which hits there sample a point of an emitter's body.
double light_sampling_density(const ReferenceScene& scene, const ReferenceBody& body, const core::Vec3d& from,
                              const core::Vec3d& place, const core::Vec3d& normal);

}  // namespace dmpc::apps

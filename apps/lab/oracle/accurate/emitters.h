// What shines by itself and is aimed at, in double precision: the product's choice of it, and arithmetic of its own.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/lab/oracle/accurate/scene.h"
#include "apps/lab/oracle/emitter_aim.h"
#include "core/database/database.h"
#include "core/picture/sample_pair.h"

namespace dmpc::apps {

/// Has the scene aim at the emitters of `database`, which was built of the same one, as often as the product does.
void aim_as_product(AccurateScene& scene, const core::Database& database);

/// An emitter, and a place on it, as the product's: by two pairs, of the place and of further digits. Nothing from within a
/// sphere, or where a triangle is seen edge-on. Requires that there is an emitter.
struct AccurateTarget : EmitterAim<double> {
  std::uint32_t body;
  core::Vec3d normal;  ///< of the emitter there
};
std::optional<AccurateTarget> aim_from(const AccurateScene& scene, const core::Vec3d& from, const core::SamplePair& place,
                                       const core::SamplePair& digits);

/// How densely hits aim from there at a place of an emitter's body, per steradian.
double aimed_density(const AccurateScene& scene, const AccurateBody& body, const core::Vec3d& from, const core::Vec3d& place,
                     const core::Vec3d& normal);

}  // namespace dmpc::apps

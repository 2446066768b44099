// All ways of computing a ray's hit that the stability tests compare.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/oracle/referee.h"
#include "apps/oracle/oracle.h"
#include "core/database/database.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Immutable once made, so any thread may trace in it.
struct StabilitySubject {
  explicit StabilitySubject(const core::Scene& scene) : StabilitySubject(scene, several_macro_cells(scene)) {}
  StabilitySubject(const core::Scene& scene, const core::BuildOptions& options)
      : database(core::build_database(scene, options)), voxels(core::build_database(scene, with_voxels(options))) {}

  static core::BuildOptions with_voxels(core::BuildOptions options) {
    options.structure = core::Structure::voxels;
    return options;
  }

  core::Database database;
  core::Database voxels;  ///< built from the same floats
  EmbreeScene embree_fast{database.primitives(), EmbreeMode::fast};
  EmbreeScene embree_robust{database.primitives(), EmbreeMode::robust};
  Referee referee{database};

  const core::GridFrame& frame() const { return database.header().frame; }
};

/// The first ten answer any ray; the others are used by the tests about them.
enum class StabilityKernel : std::uint8_t {
  grid,           ///< the traversal with vectors of 8 triangles
  scalar,         ///< the traversal with the scalar twin
  plain,          ///< the traversal that leaves empty space cell by cell
  resumed,        ///< the traversal stopped by an absent record before each of its steps
  bundle,         ///< the traversal in a bundle with three other rays
  any_hit,        ///< as a shadow ray: only whether there is a hit
  voxels,         ///< the traversal of a plain grid of voxels with lists, over the same scene
  voxels_bundle,  ///< as above, in a bundle with three other rays
  embree_fast,    ///< Embree without its robust flag
  embree_robust,  ///< Embree with its robust flag
  regions,        ///< the traversal from owner to owner of a space cut into regions
  planes,         ///< the traversal's planes alone, finest cell by finest cell
  listing,        ///< no traversal: the primitives that the boxes around a point list
  certified,      ///< hits of the grid or of its scalar twins, each with a certificate
};
inline constexpr std::size_t stability_kernel_count = 14;
inline constexpr std::size_t compared_kernel_count = 10;

constexpr std::size_t index_of(StabilityKernel kernel) { return static_cast<std::size_t>(kernel); }
constexpr bool is_embree(StabilityKernel kernel) {
  return kernel == StabilityKernel::embree_fast || kernel == StabilityKernel::embree_robust;
}
constexpr bool is_of_voxels(StabilityKernel kernel) {
  return kernel == StabilityKernel::voxels || kernel == StabilityKernel::voxels_bundle;
}
std::string_view name_of(StabilityKernel kernel);

/// By kernel. For `any_hit` only found() has a meaning.
using StabilityAnswers = std::array<core::Hit, compared_kernel_count>;

/// Traces one ray with each of the first ten kernels; Embree's answer is a miss for rays that it does not take. All except
/// `any_hit` return closest hits, whatever the ray's kind. Thread-safe.
StabilityAnswers ask_kernels(const StabilitySubject& subject, const core::Ray& ray);

/// Returns whether Embree takes `ray`: debug checks in Debian's build end the process if a number is above 1.844e18 or the ray's
/// end is not above 0.
bool embree_takes(const core::Ray& ray);

}  // namespace dmpc::apps

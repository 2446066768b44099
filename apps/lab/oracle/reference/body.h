// One primitive in double precision: its intersection with a ray, and the surface there. It shares no arithmetic with core's
// kernels and shading.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "apps/lab/oracle/reference/ray.h"
#include "core/base/box.h"
#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::apps {

/// World coordinates.
/// - triangle: `place` has its three corners
/// - sphere: place[0] is the centre, radius[0] the radius; a negative radius shows the inside only
/// - cone: place[0] and place[1] are base and apex, with their radii; any negative radius shows the inside only
struct ReferenceBody {
  static constexpr std::uint32_t flat = 0xffffffffU;

  core::PrimitiveKind kind{};
  std::array<core::Vec3d, 3> place;
  std::array<double, 2> radius{};
  std::uint32_t material = 0;
  std::uint32_t object = 0;               ///< index into core::Scene::objects
  std::uint32_t first_normal = flat;      ///< smooth triangle: index of its three normals in ReferenceScene::normals
  std::uint32_t first_place = flat;       ///< textured triangle: index of its three texture coordinates in ReferenceScene::places
  std::uint32_t first_color = flat;       ///< triangle with vertex colours: index in ReferenceScene::colors
  bool is_light_sampled = false;          ///< paths sample it as a light, as it emits
  std::array<std::uint32_t, 3> corner{};  ///< triangle: its corners' indices in the object

  bool is_smooth() const { return first_normal != flat; }
  bool is_textured() const { return first_place != flat; }
  bool has_colors() const { return first_color != flat; }
};

struct ReferenceSurface {
  core::Vec3d point;               ///< on the body, however t was rounded
  core::Vec3d normal;              ///< the body's own, of unit length: a triangle's by its winding, a curved body's outwards
  std::array<double, 3> weight{};  ///< a triangle's barycentric coordinates
};

/// Returns whether there is something to hit: a triangle has an area, a sphere a radius, a cone a length, and all coordinates are
/// below 1e30.
bool is_usable(const ReferenceBody& body);

/// Returns the least distance in (0, ray.t_max) at which `ray` meets `body`. For triangles, the signs of the volumes that the ray
/// spans with the edges decide; an edge gives both its triangles the same number, so nothing passes between them. For spheres and
/// cones, the two stable roots of the quadratic about the point of the ray nearest to the body are used.
std::optional<double> distance_to(const ReferenceBody& body, const ReferenceRay& ray);

/// As above for a ray that starts on `body`, without the offset that keeps it from its start: the second intersection with a
/// curved body. It is never outside, as all bodies bulge outwards, and never on a triangle.
std::optional<double> distance_across(const ReferenceBody& body, const ReferenceRay& ray);

/// Returns the surface where `ray` meets `body` at `t`, which distance_to() returned.
ReferenceSurface surface_at(const ReferenceBody& body, const ReferenceRay& ray, double t);

core::Box bounds_of(const ReferenceBody& body);

}  // namespace dmpc::apps

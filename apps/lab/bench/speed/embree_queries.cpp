#include "apps/lab/bench/speed/embree_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmpc::apps {

namespace {

using core::Color;
using core::Vec3d;
using core::Vec3f;

constexpr float endless = std::numeric_limits<float>::infinity();

Color highlight_of(const PlainMaterial& material, float lobe) {
  return material.is_glossy() ? material.highlight * std::pow(std::clamp(lobe, 0.0F, 1.0F), material.shine) : Color{};
}

void blend(PlainSurface& surface, const core::PatchNormals& normals, float u, float v) {
  const Vec3f blended = normals.normal[0] * (1 - u - v) + normals.normal[1] * u + normals.normal[2] * v;
  const float square = dot(blended, blended);
  if (square > 0) {
    surface.normal = blended * ((dot(blended, surface.normal) < 0 ? -1.0F : 1.0F) / std::sqrt(square));
  }
}

}  // namespace

template <class T>
std::optional<PlainSurface> EmbreeQueries::surface_along(const core::Vec3<T>& origin, const core::Vec3<T>& direction) {
  ++rays_;
  RTCRayHit asked;
  asked.ray = embree::ray_of(Vec3f(origin), Vec3f(direction), endless);
  if (stage_.is_curved()) {
    context_.origin = Vec3d(origin);
    context_.direction = Vec3d(direction);
  }
  asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::intersect(stage_.tree().library(), stage_.tree().scene(), context_.embree, asked);
  if (asked.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  return stage_.is_triangle(asked.hit.geomID)
             ? triangle_at(asked, Vec3f(origin), Vec3f(direction))
             : stage_.curved_at(asked.hit.primID, context_.origin, context_.direction, asked.ray.tfar);
}
template std::optional<PlainSurface> EmbreeQueries::surface_along(const Vec3f&, const Vec3f&);
template std::optional<PlainSurface> EmbreeQueries::surface_along(const Vec3d&, const Vec3d&);

PlainSurface EmbreeQueries::triangle_at(const RTCRayHit& asked, const Vec3f& origin, const Vec3f& direction) const {
  PlainSurface surface;
  surface.point = origin + direction * asked.ray.tfar;
  surface.geometric_normal = normalize(Vec3f{asked.hit.Ng_x, asked.hit.Ng_y, asked.hit.Ng_z});
  surface.is_leaving = dot(direction, surface.geometric_normal) > 0;
  surface.normal = surface.is_leaving ? -surface.geometric_normal : surface.geometric_normal;
  if (const core::PatchNormals* const normals = stage_.normals_of(asked.hit.primID)) {
    surface.material = normals->material();
    blend(surface, *normals, asked.hit.u, asked.hit.v);
  } else {
    surface.material = stage_.flat_material_of(asked.hit.primID);
  }
  return surface;
}

Color EmbreeQueries::lights_on(const PlainSurface& surface, const PlainMaterial& material, const Vec3f& direction) {
  const Vec3f mirror = plain_mirrored(direction, surface.normal);
  return lights_on(surface, [&](const Vec3f& towards, float scale, float cosine) {
    return material.color * (material.diffuse * cosine) + highlight_of(material, dot(mirror, towards) * scale);
  });
}

bool EmbreeQueries::is_free(const Vec3f& start, const Vec3f& direction) {
  return !meets(embree::ray_of(start, direction, endless));
}

bool EmbreeQueries::is_blocked(const Vec3f& start, const Vec3f& light) {
  return meets(embree::ray_of(start, light - start, plain_light_end));
}

bool EmbreeQueries::is_hidden(const Vec3f& start, const Vec3f& place) {
  return meets(embree::ray_of(start, place - start, plain_emitter_end));
}

bool EmbreeQueries::meets(RTCRay ray) {
  ++rays_;
  embree::occlude(stage_.tree().library(), stage_.tree().scene(), context_.embree, ray);
  return ray.tfar < 0;
}

}  // namespace dmpc::apps

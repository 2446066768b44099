#include "core/families/rounding.h"

#include "core/base/elementary.h"

namespace dmpc::core::scenes {
namespace {

double rounded(double value) { return round_to_6_digits(value); }

Vec3d rounded(const Vec3d& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

std::vector<Vec3d> rounded(const std::vector<Vec3d>& vectors) {
  std::vector<Vec3d> result;
  result.reserve(vectors.size());
  for (const Vec3d& vector : vectors) {
    result.push_back(rounded(vector));
  }
  return result;
}

}  // namespace

void RoundingSink::background(const Vec3d& color) { target_.background(rounded(color)); }

void RoundingSink::view(const View& view) {
  target_.view({rounded(view.from), rounded(view.at), rounded(view.up), rounded(view.angle_degrees), rounded(view.hither),
                view.width, view.height});
}

void RoundingSink::light(const PointLight& light) {
  target_.light({rounded(light.position), rounded(light.color), light.has_color});
}

void RoundingSink::material(const Material& material) {
  target_.material({rounded(material.color), rounded(material.diffuse), rounded(material.specular), rounded(material.shine),
                    rounded(material.transmittance), rounded(material.refraction_index)});
}

void RoundingSink::polygon(const std::vector<Vec3d>& vertices) { target_.polygon(rounded(vertices)); }

void RoundingSink::patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) {
  target_.patch(rounded(vertices), rounded(normals));
}

void RoundingSink::sphere(const Vec3d& center, double radius) { target_.sphere(rounded(center), rounded(radius)); }

void RoundingSink::cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) {
  target_.cone(rounded(base), rounded(base_radius), rounded(apex), rounded(apex_radius));
}

}  // namespace dmpc::core::scenes

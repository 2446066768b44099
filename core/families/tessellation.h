// A filter between a generator and its sink that converts spheres, cones and cylinders to smooth-shaded triangles, as the SPD
// does.
#pragma once

#include <vector>

#include "core/families/frame.h"
#include "core/scene/scene.h"

namespace dmpc::core::scenes {

/// Replaces each curved primitive by patches of 3 vertices with unit normals and passes everything else on: 12 N^2 for a sphere
/// (each face of a cube divided N by N), 8 N for a cone or cylinder (4 N sides, no caps).
class TessellatingSink final : public SceneSink {
 public:
  /// Requires tessellation >= 1. `target` must outlive the sink.
  TessellatingSink(int tessellation, SceneSink& target);

  void background(const Vec3d& color) override { target_.background(color); }
  void view(const View& view) override { target_.view(view); }
  void light(const PointLight& light) override { target_.light(light); }
  void material(const Material& material) override { target_.material(material); }
  void polygon(const std::vector<Vec3d>& vertices) override { target_.polygon(vertices); }
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override { target_.patch(vertices, normals); }
  void sphere(const Vec3d& center, double radius) override;
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override;

 private:
  struct Face;
  void add_face(const Face& face);
  void add_sphere_triangle(const Vec3d& center, double radius, const Vec3d* corner);

  SceneSink& target_;
  std::vector<Vec3d> directions_;  ///< on a unit sphere, three for each triangle, in sending order
  std::vector<Turn> turns_;        ///< around a cone's side: 4 N + 1 from 0 to a full turn
};

}  // namespace dmpc::core::scenes

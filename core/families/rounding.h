// A step between a generator and its reader that rounds every number to the 6 significant digits of an NFF file, so that a
// built-in scene and its written file are the same scene, bit for bit.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::core::scenes {

class RoundingSink final : public SceneSink {
 public:
  /// `target` must outlive the sink.
  explicit RoundingSink(SceneSink& target) : target_(target) {}

  void background(const Vec3d& color) override;
  void view(const View& view) override;
  void light(const PointLight& light) override;
  void material(const Material& material) override;
  void polygon(const std::vector<Vec3d>& vertices) override;
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override;
  void sphere(const Vec3d& center, double radius) override;
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override;

 private:
  SceneSink& target_;
};

}  // namespace dmpc::core::scenes

// Jacks: three crossed rods with balls at their ends, and eight half-sized copies at the corners of a cube, recursively.
#include "core/base/ranges.h"
#include "core/families/families.h"
#include "core/families/frame.h"
#include "core/families/tessellation.h"

namespace dmpc::core::scenes {
namespace {

constexpr int tessellation = 2;

/// Transforms entities from a frame that rotates, translates and scales uniformly. Normals are transformed by the inverse
/// transpose and not renormalised, as in the SPD's files: their length is one over the frame's scale.
class FramedSink final : public SceneSink {
 public:
  FramedSink(const Frame& frame, SceneSink& target) : frame_(frame), scale_(length(frame.x)), target_(target) {}

  void background(const Vec3d& color) override { target_.background(color); }
  void view(const View& view) override { target_.view(view); }
  void light(const PointLight& light) override { target_.light(light); }
  void material(const Material& material) override { target_.material(material); }
  void polygon(const std::vector<Vec3d>& vertices) override { target_.polygon(points(vertices)); }
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override {
    std::vector<Vec3d> carried =
        mapped<Vec3d>(normals, [&](const Vec3d& normal) { return frame_.vector(normal) * (1 / (scale_ * scale_)); });
    target_.patch(points(vertices), carried);
  }
  void sphere(const Vec3d& center, double radius) override { target_.sphere(frame_.point(center), radius * scale_); }
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override {
    target_.cone(frame_.point(base), base_radius * scale_, frame_.point(apex), apex_radius * scale_);
  }

 private:
  std::vector<Vec3d> points(const std::vector<Vec3d>& vertices) const {
    return mapped<Vec3d>(vertices, [&](const Vec3d& vertex) { return frame_.point(vertex); });
  }

  Frame frame_;
  double scale_;
  SceneSink& target_;
};

void add_jack(SceneSink& sink) {
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3d& axis : axes) {
    sink.cone(-axis, 0.1, axis, 0.1);
  }
  for (const double end : {1.0, -1.0}) {
    for (const Vec3d& axis : axes) {
      sink.sphere(end * axis, 0.2);
    }
  }
}

void add_jacks(const Frame& frame, int levels, bool is_tessellated, SceneSink& sink) {
  FramedSink framed(compose(frame, scaling(0.75)), sink);
  TessellatingSink tessellated(tessellation, framed);
  add_jack(is_tessellated ? static_cast<SceneSink&>(tessellated) : framed);
  if (levels == 1) {
    return;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d offset = {(corner & 4) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 1) != 0 ? 0.5 : -0.5};
    add_jacks(compose(frame, compose(translation(offset), scaling(0.5))), levels - 1, is_tessellated, sink);
  }
}

}  // namespace

void make_jacks(int size, bool is_tessellated, SceneSink& sink) {
  set_stage(
      sink,
      {.from = {0, 0, -8}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 25, .hither = 0.001, .width = 256, .height = 256},
      {{-10, 3, -20}}, {0.2, 0.05, 0.2});
  sink.material({.color = {0.737, 0.561, 0.561}, .diffuse = 0.7, .specular = 0.7, .shine = 11.1434, .refraction_index = 1});
  add_jacks(compose(rotation_x(turn_degrees(-30)), rotation_y(turn_degrees(-20))), size, is_tessellated, sink);
}

}  // namespace dmpc::core::scenes

// Tree: branches that fork in two, cones with balls at the joints, under seven lights.
#include "core/families/families.h"
#include "core/families/frame.h"

namespace dmpc::core::scenes {
namespace {

constexpr double taper = 0.67, trunk_radius = 0.15;

/// A child's frame in its parent's: at the parent's end, shorter, rotated and tilted.
Frame child_frame(double scale, double turn, double lean) {
  return compose(translation({0, 0, 1}),
                 compose(scaling(scale), compose(rotation_z(turn_degrees(turn)), rotation_x(turn_degrees(lean)))));
}

void add_branch(const Frame& frame, double thickness, int depth, SceneSink& sink) {
  const Vec3d base = frame.point({0, 0, 0}), apex = frame.point({0, 0, 1});
  const double apex_radius = trunk_radius * thickness * taper;
  sink.cone(base, trunk_radius * thickness, apex, apex_radius);
  sink.sphere(apex, apex_radius);
  if (depth > 0) {
    add_branch(compose(frame, child_frame(0.65, 90, 40)), thickness * taper, depth - 1, sink);
    add_branch(compose(frame, child_frame(0.70, 230, 25)), thickness * taper, depth - 1, sink);
  }
}

}  // namespace

void make_tree(int size, SceneSink& sink) {
  set_stage(sink, {.from = {4.5, 0.4, 2}, .at = {0, 0, 1.5}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 1},
            {{-5, 5, 50}, {30, -30, 30}, {-40, -30, 20}, {10, 30, 40}, {-30, 40, 10}, {50, 25, 20}, {-10, -60, 30}});
  sink.material({.color = {0.2, 0.7, 0.2}, .diffuse = 1, .specular = 0, .shine = no_highlight, .refraction_index = 0});
  floor_square(sink, 50, 0);
  sink.material({.color = {0.55, 0.4, 0.2}, .diffuse = 1, .specular = 0, .shine = no_highlight, .refraction_index = 0});
  add_branch({}, 1, size, sink);
}

}  // namespace dmpc::core::scenes

// Tetra: Sierpinski's tetrahedron.
#include <array>

#include "core/families/families.h"

namespace dmpc::core::scenes {
namespace {

/// The corners of a cube that form a regular tetrahedron: those whose signs multiply to +1.
constexpr std::array<Vec3d, 4> corners = {Vec3d{-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1}};

void add_tetrahedron(int depth, const Vec3d& center, double reach, SceneSink& sink) {
  if (depth > 1) {
    for (const Vec3d& corner : corners) {
      add_tetrahedron(depth - 1, center + corner * (reach / 2), reach / 2, sink);
    }
    return;
  }
  const Vec3d p0 = center + reach * corners[0], p1 = center + reach * corners[1];
  const Vec3d p2 = center + reach * corners[2], p3 = center + reach * corners[3];
  sink.polygon({p0, p1, p2});
  sink.polygon({p3, p2, p1});
  sink.polygon({p2, p3, p0});
  sink.polygon({p1, p0, p3});
}

}  // namespace

void make_tetra(int size, SceneSink& sink) {
  set_stage(sink,
            {.from = {1.022846, -3.177154, -2.174512},
             .at = {-0.004103, -0.004103, 0.216539},
             .up = {-0.816497, -0.816497, 0.816497},
             .angle_degrees = 45,
             .hither = 1},
            {{2, -18, -5}});
  sink.material({.color = {1, 0.2, 0.2}, .diffuse = 1, .specular = 0, .shine = no_highlight, .refraction_index = 0});
  add_tetrahedron(size, {0, 0, 0}, 1, sink);
}

}  // namespace dmpc::core::scenes

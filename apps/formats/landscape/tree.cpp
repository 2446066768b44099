#include "apps/formats/landscape/tree.h"

#include <array>
#include <cmath>
#include <utility>

#include "apps/formats/landscape/chance.h"
#include "core/base/expect.h"
#include "core/base/vec.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;

constexpr double trunk_radius = 0.03, leaf_size = 0.04;

/// Four rings of six squares, thinner towards the top.
LandscapeMesh trunk() {
  constexpr std::uint32_t sides = 6, rings = 4;
  const double half = std::sqrt(3.0) / 2;
  const std::array<Vec3d, sides> around{
      {{1, 0, 0}, {0.5, 0, half}, {-0.5, 0, half}, {-1, 0, 0}, {-0.5, 0, -half}, {0.5, 0, -half}}};
  LandscapeMesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const double height = 0.9 * ring / rings, radius = trunk_radius * (1 - height);
    for (const Vec3d& way : around) {
      add_vertex(mesh, way * radius + Vec3d{0, height, 0}, way);
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t here = ring * sides + side, beside = ring * sides + (side + 1) % sides;
      const std::uint32_t above = here + sides, over = beside + sides;
      mesh.indices.insert(mesh.indices.end(), {here, above, beside, beside, above, over});
    }
  }
  return mesh;
}

/// Where a leaf grows, and away from where.
struct Bud {
  Vec3d place, outwards;
};

/// In a cone, denser towards its outside.
Bud bud_of_conifer(Chance& chance, double width) {
  const double height = chance.share(), outside = 0.4 + 0.6 * chance.share();
  Vec3d way;
  do {
    way = {chance.signed_share(), 0, chance.signed_share()};
  } while (dot(way, way) > 1 || dot(way, way) < 0.01);
  const Vec3d outwards = normalize(way);
  return {outwards * (width * (1 - height) * outside) + Vec3d{0, 0.15 + 0.85 * height, 0}, outwards};
}

/// In an ellipsoid.
Bud bud_of_broad_leaved(Chance& chance, double width) {
  Vec3d way;
  do {
    way = {chance.signed_share(), chance.signed_share(), chance.signed_share()};
  } while (dot(way, way) > 1 || dot(way, way) < 0.1);
  return {Vec3d{way.x * width, 0.65 + 0.35 * way.y, way.z * width}, normalize(way)};
}

LandscapeMesh crown(std::size_t kind) {
  const bool is_conifer = kind % 2 == 0;
  const double width = is_conifer ? 0.2 + 0.03 * static_cast<double>(kind) : 0.25 + 0.05 * static_cast<double>(kind);
  Chance chance(kind);
  LandscapeMesh mesh;
  for (std::uint32_t leaf = 0; leaf < leaf_triangles; ++leaf) {
    const Bud bud = is_conifer ? bud_of_conifer(chance, width) : bud_of_broad_leaved(chance, width);
    const Vec3d turned{chance.signed_share(), chance.signed_share(), chance.signed_share()};
    const Vec3d tip = normalize(bud.outwards * 1.5 + turned), side = normalize(cross(tip, bud.outwards + Vec3d{0, 0.5, 0.1}));
    const Vec3d normal = normalize(bud.outwards + Vec3d{0, 0.7, 0});  // of the crown, so that it looks round
    for (const Vec3d& corner : {tip * leaf_size, side * (leaf_size / 2), side * (-leaf_size / 2)}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      add_vertex(mesh, bud.place + corner, normal);
    }
  }
  return mesh;
}

}  // namespace

Tree tree(std::size_t kind) {
  core::expect(kind < tree_kinds, "a tree is of one of the kinds that there are");
  return {trunk(), crown(kind)};
}

}  // namespace dmpc::apps

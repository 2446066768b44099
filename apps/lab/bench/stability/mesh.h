// Closed triangle meshes, as indices into shared vertices.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct Mesh {
  std::vector<core::Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Edge length 2, about the origin, two triangles a face, normals outwards.
inline Mesh cube() {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0, (i & 4U) != 0 ? 1.0 : -1.0});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

/// About the origin, with every other corner of the cube; normals outwards.
inline Mesh tetrahedron() {
  return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A sphere of radius 1 with two poles, `rings` - 1 circles and `sectors` meridians; every radius is shortened by up to `noise`.
inline Mesh sphere_mesh(std::uint32_t rings, std::uint32_t sectors, double noise) {
  Mesh mesh;
  Random random(rings * 1000 + sectors);
  const auto add = [&](double polar, double azimuth) {
    const core::Vec3d v{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    mesh.vertices.push_back(v * (1.0 - noise * random.unit()));
  };
  add(0, 0);
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      add(std::numbers::pi * ring / rings, 2 * std::numbers::pi * sector / sectors);
    }
  }
  add(std::numbers::pi, 0);
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) { return 1 + (ring - 1) * sectors + sector % sectors; };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t sector = 0; sector < sectors; ++sector) {
    mesh.triangles.push_back({0, at(1, sector), at(1, sector + 1)});
    for (std::uint32_t ring = 1; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
      mesh.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
    }
    mesh.triangles.push_back({last, at(rings - 1, sector + 1), at(rings - 1, sector)});
  }
  return mesh;
}

/// About the z axis: radius 1 to the middle of a tube of radius `tube`.
inline Mesh torus(std::uint32_t around, std::uint32_t along_tube, double tube) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < along_tube; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along_tube;
      const double reach = 1 + tube * std::cos(b);
      mesh.vertices.push_back({reach * std::cos(a), reach * std::sin(a), tube * std::sin(b)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * along_tube + j % along_tube; };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < along_tube; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

inline Mesh moved(Mesh mesh, double factor, const core::Vec3d& offset) {
  for (core::Vec3d& v : mesh.vertices) {
    v = v * factor + offset;
  }
  return mesh;
}

/// Returns the mesh with vertices rounded to single precision; triangles stay joined, since equal vertices round alike.
inline Mesh rounded(Mesh mesh) {
  for (core::Vec3d& v : mesh.vertices) {
    v = core::Vec3d(core::Vec3f(v));
  }
  return mesh;
}

inline void add(core::Scene& scene, const Mesh& mesh) {
  core::SceneBuilder builder(scene);
  for (const auto& t : mesh.triangles) {
    builder.polygon({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
}

inline core::Scene scene_of(const Mesh& mesh) {
  core::Scene scene;
  add(scene, mesh);
  return scene;
}

}  // namespace dmpc::apps

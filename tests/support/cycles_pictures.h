// Small pictures of polygons by paths, held against those that Blender's Cycles made of the same scenes.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/picture/surfaces/transport.h"
#include "tests/support/film_of.h"
#include "tests/support/scaled.h"
#include "tests/support/tables.h"

namespace dmpc::tests::cycles {

inline constexpr int side = 16, leaves = 4;
/// Red, green and blue.
using Light = std::array<double, 3>;
/// 4x4 pixels each, row by row from the top left.
using Leaves = std::array<Light, leaves * leaves>;

/// Polygons, z up, before a camera whose angle spans its pixels from side to side.
class Model {
 public:
  Model(const core::Vec3d& from, const core::Vec3d& at, double angle_degrees) : builder_(scene_) {
    const double half = angle_degrees * 3.14159265358979323846 / 360;
    const double middles = 2 * std::atan(std::tan(half) * (side - 1) / side);
    scene_.view = {.from = from, .at = at, .up = {0, 0, 1}, .angle_degrees = middles * 180 / 3.14159265358979323846};
  }
  void fill(const core::Vec3d& color) { builder_.material({.color = color}); }
  void fill(const core::Vec3d& color, const core::Microfacets& facets) {
    builder_.material({.color = color, .microfacets = facets});
  }
  void shine(const core::Vec3d& light) { builder_.material({.color = {0, 0, 0}, .emission = light}); }
  void face(const std::vector<core::Vec3d>& corners) { builder_.polygon(corners); }
  void floor(double low, double high) { face({{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}}); }
  void box(const core::Vec3d& low, const core::Vec3d& high) {
    const auto at = [&](bool x, bool y, bool z) {
      return core::Vec3d{x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z};
    };
    for (const bool far : {false, true}) {
      face({at(far, false, false), at(far, true, false), at(far, true, true), at(far, false, true)});
      face({at(false, far, false), at(true, far, false), at(true, far, true), at(false, far, true)});
      face({at(false, false, far), at(true, false, far), at(true, true, far), at(false, true, far)});
    }
  }
  const core::Scene& scene() const { return scene_; }

 private:
  core::Scene scene_;
  core::SceneBuilder builder_;
};

/// Light sampling of up to 100 emitters.
inline core::Film film_of(const core::Scene& scene, int samples, int bounces, const core::Transport& transport) {
  core::BuildOptions options = apps::several_macro_cells(scene);
  options.emitters_max = 100;
  options.for_paths = true;
  return tests::film_of(core::build_database(scene, options), scene.view, {transport, side, side, samples, bounces});
}

inline Light leaf_of(const core::Film& film, std::uint32_t leaf) {
  constexpr std::uint32_t edge = side / leaves;
  Light sum{};
  for (std::uint32_t i = 0; i < edge * edge; ++i) {
    const std::uint32_t x = leaf % leaves * edge + i % edge, y = leaf / leaves * edge + i / edge;
    const core::Vec3d light = film.radiance(y * side + x);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      sum[channel] += light[channel] / (edge * edge);
    }
  }
  return sum;
}

/// What Cycles made of a scene.
inline Leaves cycles_of(const std::string& name) {
  std::vector<double> light;
  for (const auto& row : rows_in("core/picture/cycles.txt", leaves, name)) {
    for (const std::string& cell : row) {
      const std::vector<double> leaf = numbers_of(cell);
      light.insert(light.end(), leaf.begin(), leaf.end());
    }
  }
  Leaves all;
  core::expect(light.size() == all.size() * 3, "each block has a light of three channels");
  for (std::size_t i = 0; i < light.size(); ++i) {
    all[i / 3][i % 3] = light[i];
  }
  return all;
}

/// Each block to 0.006, or to that share of it, and the whole to 0.5 %, where a slow build's samples are not too few for it.
inline void check(const core::Film& film, const std::string& name) {
  const Leaves cycles = cycles_of(name);
  constexpr double few = slowness == 1 ? 1 : 10;
  Light all{}, expected{};
  for (std::uint32_t leaf = 0; leaf < cycles.size(); ++leaf) {
    const Light light = leaf_of(film, leaf);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      CAPTURE(leaf);
      CAPTURE(channel);
      const double off = 0.006 * std::max(1.0, cycles[leaf][channel]) * few;
      CHECK(std::fabs(light[channel] - cycles[leaf][channel]) < off);
      all[channel] += light[channel];
      expected[channel] += cycles[leaf][channel];
    }
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    CHECK(all[channel] == doctest::Approx(expected[channel]).epsilon(0.005 * few).scale(0));
  }
}

inline constexpr int samples = static_cast<int>(1024 / slowness);

}  // namespace dmpc::tests::cycles

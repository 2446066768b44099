// What most SPD scenes share: the background, a 512x512 view at 45 degrees, lights without colour, one-quad floors.
#pragma once

#include <initializer_list>

#include "core/scene/scene.h"

namespace dmpc::core::scenes {

inline constexpr Vec3d sky{0.078, 0.361, 0.753};
/// The shine that stands for "no highlight", always with Ks = 0.
inline constexpr double no_highlight = 100000;
/// The shine whose highlight falls to one half at 37 degrees: ln .5 / ln cos 37 degrees.
inline constexpr double soft_highlight = 3.0827;

/// Background, view and lights, in the order of the SPD's files.
inline void set_stage(SceneSink& sink, const View& view, std::initializer_list<Vec3d> lights, const Vec3d& background = sky) {
  sink.background(background);
  sink.view(view);
  for (const Vec3d& position : lights) {
    sink.light({.position = position});
  }
}

/// A square of half-width `reach` about the z axis at height z, facing up.
inline void floor_square(SceneSink& sink, double reach, double z) {
  sink.polygon({{reach, reach, z}, {-reach, reach, z}, {-reach, -reach, z}, {reach, -reach, z}});
}

}  // namespace dmpc::core::scenes

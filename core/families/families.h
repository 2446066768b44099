// The generators of the Standard Procedural Databases (E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A
// 7(11), 1987). Each sends its scene of the given size to a sink, entity by entity in the order of the SPD's files, unrounded.
// core/families/scenes.h checks sizes. Thread safety: all are pure except for what they send.
#pragma once

#include <initializer_list>

#include "core/scene/scene.h"

namespace dmpc::core::scenes {

void make_balls(int size, SceneSink& sink);
void make_gears(int size, SceneSink& sink);
/// Jacks are the only family tessellated in the object's own frame, always with 2 pieces per quarter.
void make_jacks(int size, bool is_tessellated, SceneSink& sink);
void make_lattice(int size, SceneSink& sink);
/// Requires size <= 7: beyond that the hash of 1987 shifts by a negative count.
void make_mount(int size, SceneSink& sink);
void make_rings(int size, SceneSink& sink);
void make_shells(int size, SceneSink& sink);
void make_sombrero(int size, SceneSink& sink);
void make_teapot(int size, SceneSink& sink);
void make_tetra(int size, SceneSink& sink);
void make_tree(int size, SceneSink& sink);

inline constexpr Vec3d sky{0.078, 0.361, 0.753};
/// The shininess that means "no highlight", always with Ks = 0.
inline constexpr double no_highlight = 100000;
/// The shininess whose highlight falls to one half at 37 degrees: ln .5 / ln cos 37 degrees.
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

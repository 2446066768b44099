// The generators of the Standard Procedural Databases (E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A
// 7(11), 1987): each sends its scene of the given size to a sink, entity by entity in the order of the SPD's own files,
// unrounded. Sizes are checked by core/families/scenes.h. Thread safety: all are pure but for what they send.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::core::scenes {

void make_balls(int size, SceneSink& sink);
void make_gears(int size, SceneSink& sink);
/// The jacks are the one family tessellated in the object's own frame, always with 2 pieces a quarter.
void make_jacks(int size, bool is_tessellated, SceneSink& sink);
void make_lattice(int size, SceneSink& sink);
/// Requires size <= 7: beyond it the hash of 1987 shifts by a negative count.
void make_mount(int size, SceneSink& sink);
void make_rings(int size, SceneSink& sink);
void make_shells(int size, SceneSink& sink);
void make_sombrero(int size, SceneSink& sink);
void make_teapot(int size, SceneSink& sink);
void make_tetra(int size, SceneSink& sink);
void make_tree(int size, SceneSink& sink);

}  // namespace dmpc::core::scenes

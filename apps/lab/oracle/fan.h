// The triangles around an edge or a vertex: if they close up, no ray may slip through, however it is rounded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// Returns the ids of the triangles around a vertex or edge if `ray` passes triangle `id` within float rounding of exactly one of
/// its vertices or edges, and the triangles that share it bit for bit cover all its surroundings as seen along the ray; else
/// nothing. A watertight renderer rounds shared vertices alike, so it must hit one of them. Not closed are triangles that merely
/// touch, the border of a mesh, a fold, a fan that holds the ray's ignored triangle, and a fan whose border lies within rounding
/// of the ray, as with a triangle seen edge-on.
std::vector<std::uint32_t> closed_fan(const core::Ray& ray, std::span<const core::PrimitiveValues> primitives, std::uint32_t id);

}  // namespace dmpc::apps

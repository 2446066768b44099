// The triangles around an edge or a vertex: where they close up, no ray may slip through, however it is rounded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// If `ray` passes triangle `id` within float rounding of exactly one of its vertices, or of exactly one of its edges, and the
/// triangles that share this vertex or edge bit for bit cover all its surroundings as the ray sees them, their ids; else nothing.
/// A watertight renderer rounds shared vertices alike, so it must hit one of them. Triangles that merely touch, the border of a
/// mesh, a fold, and a fan that holds the ray's ignored triangle are not closed; nor is one whose border lies within rounding of
/// the ray, as that of a triangle seen edge-on may.
std::vector<std::uint32_t> closed_fan(const core::Ray& ray, std::span<const core::PrimitiveValues> primitives, std::uint32_t id);

}  // namespace dmpc::apps

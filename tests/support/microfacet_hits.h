// Hits on surfaces of microfacets, of which all is known, as tests need them.
#pragma once

#include <bit>
#include <cmath>

#include "core/database/shading/material_records.h"
#include "core/picture/hits/hit_state.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// A material of microfacets.
inline core::Material microfacets(const core::Vec3d& base, double metallic, double alpha) {
  return {.color = base, .microfacets = {.roughness = std::sqrt(alpha), .metallic = metallic}};
}

/// As core/picture/shade.cpp leaves it at the lights; the normal is z, the eye lies along `out`.
inline core::HitState hit_on(const core::Material& material, const core::Vec3d& out) {
  const core::MaterialRecords records = core::material_records({material}, true);
  const auto facets = std::bit_cast<core::MicrofacetRecord>(records.finishes.at(0));
  core::HitState state;
  state.geometric_normal = state.normal = {0, 0, 1};
  state.ray.go_along(-out);
  state.surface = {.material = records.materials.at(0)};
  state.set_microfacets({.metallic = facets.metallic,
                         .alpha = facets.alpha,
                         .reflectance = facets.reflectance,
                         .there = state.surface.material.specular});
  state.surface.material.specular = 0;
  state.surface.material.refraction_index = facets.refraction_index;
  state.has_refraction = true;
  state.stage = core::HitState::Stage::continued;
  return state;
}

/// At this cosine with z.
inline core::Vec3d eye_at(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

}  // namespace dmpc::tests

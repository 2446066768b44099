// Layers beside a picture: what denoisers and compositors read of the surfaces that the eye sees first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/vec.h"
#include "core/picture/hits/hit_state.h"
#include "core/record/record.h"

namespace dmpc::core {

/// What a film shows: light, or a property of the first surfaces that alpha does not leave out. A layer is rendered as a picture
/// of its own, in which these surfaces are matt, have the layer's colour, and see nothing but ambient light of 1.
enum class Layer : std::uint8_t {
  light,   ///< the picture
  albedo,  ///< by channels, the share of light that is scattered, mirrored or transmitted: at most 1
  normal,  ///< shading normal on the eye's side, along the world's axes; as a colour, which is never negative, (normal + 1) / 2
  depth,   ///< distance from the eye, in the world's unit
  id       ///< 1 + the primitive's number
};
inline constexpr std::array<std::string_view, 5> layer_names = {"light", "albedo", "normal", "depth", "id"};
constexpr std::string_view name_of(Layer layer) { return layer_names[static_cast<std::size_t>(layer)]; }

/// Whether a pixel is the mean of its samples. Distances and numbers are those of one ray through its middle.
constexpr bool is_mean(Layer layer) { return layer != Layer::depth && layer != Layer::id; }

/// Takes all light from a scene but what shows the layer.
void show(Layer layer, DatabaseHeader& header);

/// The colour of a surface whose light is known, before alpha. `metallic`: its share of metal, if it has microfacets. `eye` is
/// grid-local; `scale`: of the grid.
Color layer_color(Layer layer, const HitState& state, float metallic, const Vec3d& eye, double scale);

}  // namespace dmpc::core

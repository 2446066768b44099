// How much light a surface of microfacets can send on, whatever the directions.
#pragma once

#include "core/scene/scene.h"

namespace dmpc::core {

struct MicrofacetBound {
  double direct = 0;     ///< in any channel, pi times MicrofacetLobes::response(): of a point light's
  double passed_on = 0;  ///< in any channel, the weight of MicrofacetLobes::step()
};

/// Of a material that has microfacets, whose colour is multiplied by no more than `texture_max`. `facets`: its texture of metal
/// and roughness, if it has one.
MicrofacetBound bound_of(const Material& material, double texture_max = 1, const Texture* facets = nullptr);

/// The share of light that it sends on straight ahead, in the brightest channel, if the tiny mirrors lose none: more than 1 gives
/// more light than comes.
double sent_on_straight(const Material& material);

}  // namespace dmpc::core

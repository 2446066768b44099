// Settings for a layer beside a picture.
#pragma once

#include <cstdint>

#include "core/picture/pixel_task.h"
#include "core/picture/surfaces/layer.h"

namespace dmpc::core {

/// The samples of a pixel of a layer of means, beside a picture with a number of samples that differs from pixel to pixel: as
/// many as all of its pixels by paths have, at the same places.
inline constexpr int refined_layer_samples = static_cast<int>(least_refined_samples(ErrorKind::noise));

/// Settings for rendering the layer with the picture's camera, samples and filter, by any strategy, on nodes of its own. Where
/// nothing is seen albedo, depth and id are 0, and the normal's colour is 1/2.
RenderSettings layer_settings(Layer layer, const RenderSettings& picture);

}  // namespace dmpc::core

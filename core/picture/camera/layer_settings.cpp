#include "core/picture/camera/layer_settings.h"

#include <algorithm>

#include "core/base/vec.h"
#include "core/picture/film/film_scale.h"
#include "core/record/record.h"

namespace dmpc::core {
namespace {

/// Of surfaces one behind the other that alpha leaves out.
constexpr int depth_max = 32;

/// The largest number of a channel.
double bound_of(Layer layer, const RenderSettings& picture) {
  const GridFrame& frame = picture.header.frame;
  const Vec3d extent = grid_high(frame) - frame.low;
  switch (layer) {
    case Layer::depth:
      return (length(picture.camera.eye() - frame.low) + length(extent)) / frame.scale;
    case Layer::id:
      return double{1} + picture.header.primitive_count;
    default:
      return 1;
  }
}

}  // namespace

RenderSettings layer_settings(Layer layer, const RenderSettings& picture) {
  const int samples = !is_mean(layer) ? 1 : picture.refinement.is_wanted() ? refined_layer_samples : picture.camera.samples();
  const double bound = bound_of(layer, picture);
  RenderSettings settings = picture;
  settings.camera = picture.camera.with_samples(samples);
  settings.shade = {.depth_max = depth_max,
                    .layer = layer,
                    .pixel_share = picture.shade.pixel_share,
                    .first_samples = static_cast<std::uint32_t>(samples),
                    .film_scale = film_scale_for(bound, bound, static_cast<std::uint32_t>(samples))};
  settings.refinement = {};
  settings.skips.zero_terms = true;
  show(layer, settings.header);
  return settings;
}

}  // namespace dmpc::core

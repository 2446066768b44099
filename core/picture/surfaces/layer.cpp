#include "core/picture/surfaces/layer.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::core {
namespace {

Color grey(double value) {
  const auto rounded = static_cast<float>(value);
  return {rounded, rounded, rounded};
}

/// Mirrors and glass count as Open Image Denoise asks for: metals by their reflectance at normal incidence, glass by 1.
Color albedo_of(const HitState& state, float metallic) {
  const MaterialRecord& material = state.surface.material;
  Color sent = material.color * material.diffuse + grey(double{material.transmittance});
  if (state.has_microfacets()) {
    sent = sent + material.color * (metallic * material.specular);
  } else {
    sent = sent + state.gloss().tint * (material.specular * state.gloss().mirror);
  }
  return {std::clamp(sent.x, 0.0F, 1.0F), std::clamp(sent.y, 0.0F, 1.0F), std::clamp(sent.z, 0.0F, 1.0F)};
}

}  // namespace

void show(Layer layer, DatabaseHeader& header) {
  if (layer == Layer::light) {
    return;
  }
  header.light_count = 0;
  header.has_emission = 0;
  header.ambient = {1, 1, 1};
  header.background = grey(layer == Layer::normal ? 0.5 : 0.0);
  header.sky = {};
}

Color layer_color(Layer layer, const HitState& state, float metallic, const Vec3d& eye, double scale) {
  switch (layer) {
    case Layer::albedo:
      return albedo_of(state, metallic);
    case Layer::normal:
      return Color(state.normal * 0.5 + Vec3d{0.5, 0.5, 0.5});
    case Layer::depth:
      return grey(length(state.point - eye) / scale);
    case Layer::id:
      return grey(double{1} + state.hit.primitive);
    case Layer::light:
      break;
  }
  expect(false, "a layer is no light");
  return {};
}

}  // namespace dmpc::core

#include "apps/lab/bench/speed/plain_renderer.h"

#include <algorithm>
#include <cmath>

#include "apps/edge/line/number_text.h"
#include "apps/lab/bench/speed/plain_asker.h"
#include "apps/lab/bench/speed/plain_tiles.h"
#include "core/base/expect.h"
#include "core/record/sky.h"

namespace dmpc::apps {

namespace {

using core::Color;
using core::Vec3f;

}  // namespace

/// One thread at work.
class PlainRenderer::Painter : public PlainAsker {
 public:
  using PlainAsker::PlainAsker;

  Color light_along(const Vec3f& origin, const Vec3f& direction, int depth) {
    const std::optional<PlainSurface> surface = surface_along(origin, direction);
    if (!surface) {
      return stage().settings().header.background;
    }
    const PlainMaterial& material = stage().materials()[surface->material];
    Color light = material.emission + stage().settings().header.ambient * (material.color * material.diffuse) +
                  lights_on(*surface, material, direction);
    if (depth < stage().settings().shade.depth_max) {
      light = light + passed_on(*surface, material, direction, depth);
    }
    return light;
  }

 private:
  /// What comes by reflection and refraction.
  Color passed_on(const PlainSurface& surface, const PlainMaterial& material, const Vec3f& direction, int depth) {
    const float inside = material.inside_index();
    const float index = surface.is_leaving ? inside : 1 / inside, cosine = -dot(direction, surface.normal);
    const float behind = 1 - index * index * (1 - cosine * cosine);
    const bool is_total = index > 1 && behind < 0;
    const float total = is_total ? material.transmittance : 0;
    const Color share = material.highlight * material.mirror + Color{total, total, total};
    Color light{};
    if (!(share == Color{})) {
      const Vec3f towards = normalize(plain_mirrored(direction, surface.normal));
      light = light_along(plain_start(surface, towards), towards, depth + 1) * share;
    }
    if (!is_total && material.transmittance > 0) {
      const Vec3f bent = direction * index + surface.normal * (index * cosine - std::sqrt(std::max(behind, 0.0F)));
      const Vec3f towards = normalize(bent);
      light = light + light_along(plain_start(surface, towards), towards, depth + 1) * material.transmittance;
    }
    return light;
  }
};

PlainRenderer::PlainRenderer(const Subject& subject) : stage_(std::make_unique<PlainStage>(subject)) {
  core::expect(!core::has_sky_picture(subject.settings.header), "the plain renderer knows skies of colours alone, no pictures");
}
PlainRenderer::~PlainRenderer() = default;

const Times& PlainRenderer::build_times() const { return stage_->tree().build_times(); }

PlainPicture PlainRenderer::render(std::uint32_t thread_count) const {
  if (stage_->settings().shade.transport.is_by_paths()) {
    return render_paths(thread_count);
  }
  return painted<Painter>(*stage_, thread_count, [this](Painter& painter, int x, int y) {
    return painter.light_along(stage_->camera().eye, stage_->camera().towards(x, y), 1);
  });
}

double distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
    const core::Vec3d apart = core::Vec3d(picture.pixels[pixel]) - film.radiance(pixel);
    sum += dot(apart, apart);
  }
  const double distance = std::sqrt(sum / (3.0 * static_cast<double>(picture.pixels.size())));
  if (!(distance <= plain_error_max)) {
    throw core::InternalError("the plain renderer's picture of " + scene + " is " + fixed(255 * distance, 2) +
                              "/255 from ours, root mean square: expected 1/255 at most");
  }
  return distance;
}

}  // namespace dmpc::apps

// The plain renderer by paths.
#include <limits>
#include <numbers>
#include <optional>

#include "apps/lab/bench/speed/plain_asker.h"
#include "apps/lab/bench/speed/plain_emitters.h"
#include "apps/lab/bench/speed/plain_lobes.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/lab/bench/speed/plain_tiles.h"
#include "core/picture/emitter_light.h"
#include "core/picture/path_step.h"
#include "core/picture/sample_pair.h"
#include "core/picture/surface_response.h"
#include "core/record/sky.h"

namespace dmpc::apps {

namespace {

using core::brightest;
using core::Color;
using core::Vec3f;

/// A path on its way.
struct Walk {
  std::uint32_t pixel, sample;
  Vec3f origin, direction;
  Color weight{1, 1, 1};
  int depth = 1;
  bool is_scattered = false;                               ///< by some surface before: it finds no backdrop
  float density = std::numeric_limits<float>::infinity();  ///< of the direction

  core::SamplePair pair(core::Purpose purpose) const { return core::pair_of(pixel, sample, depth, purpose); }
};

/// Whether the path survives roulette, and then counts for those that do not.
bool survives(const Walk& walk, float chance, int roulette_from, PlainWay& way) {
  const float share = brightest(walk.weight * way.weight);
  if (walk.depth < roulette_from || share >= 1) {
    return share > 0;
  }
  way.weight = way.weight * (1 / share);
  return chance < share;
}

/// What counts of light by a way of this density, if another might have brought it with density `other`.
float way_share(float own, float other) { return static_cast<float>(core::way_share(double{own}, double{other})); }

}  // namespace

/// One thread at work.
class PlainRenderer::Walker : public PlainAsker {
 public:
  explicit Walker(const PlainStage& stage)
      : PlainAsker(stage), settings_(stage.settings()), ray_depth_max_(core::ray_depth_max(settings_.shade, settings_.header)) {}

  Color mean_of(int column, int row) {
    const auto pixel = static_cast<std::uint32_t>(row * settings_.camera.width() + column);
    const auto samples = static_cast<std::uint32_t>(settings_.camera.samples());
    core::Vec3d sum;
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      sum = sum + core::Vec3d(light_of(begun(pixel, sample)));
    }
    return Color(sum * (1.0 / samples));
  }

 private:
  Walk begun(std::uint32_t pixel, std::uint32_t sample) const {
    const auto width = static_cast<std::uint32_t>(settings_.camera.width());
    float x = static_cast<float>(pixel % width), y = static_cast<float>(pixel / width);
    if (settings_.camera.samples() > 1) {
      const core::SamplePosition place = core::sample_position(pixel, sample);
      x += static_cast<float>(place.x) - 0.5F;
      y += static_cast<float>(place.y) - 0.5F;
    }
    return {.pixel = pixel, .sample = sample, .origin = stage().camera().eye, .direction = stage().camera().towards(x, y)};
  }

  Color light_of(Walk walk) {
    Color light{};
    while (const std::optional<PlainSurface> surface = surface_along(walk.origin, walk.direction)) {
      const PlainMaterial& material = stage().materials()[surface->material];
      light = light + walk.weight * material.emission * share_met(walk, *surface, material);
      if (walk.depth > depth_max() || !step(walk, *surface, material, light)) {
        return light;
      }
    }
    return light + walk.weight * light_beyond(walk);
  }

  /// Of what a surface shines with: the rest comes to the hit before, which has aimed at it.
  float share_met(const Walk& walk, const PlainSurface& surface, const PlainMaterial& material) const {
    const bool may_be_aimed_at = surface.material >= settings_.header.drawn_materials;
    return may_be_aimed_at && walk.density < std::numeric_limits<float>::infinity()
               ? way_share(walk.density, plain_density_met(stage(), surface, walk.origin, walk.direction, material.emission))
               : 1;
  }

  /// Shadow rays, and the way on; nothing more is to be found if this says no.
  bool step(Walk& walk, const PlainSurface& surface, const PlainMaterial& material, Color& light) {
    const PlainLobes lobes(material, surface, walk.direction);
    light = light + walk.weight * points_on(surface, material, lobes, walk.direction);
    const bool is_last = walk.depth >= ray_depth_max_;
    if (!is_last && !stage().emitters().empty() && lobes.scatters()) {
      light = light + walk.weight * aimed_light(walk, surface, lobes);
    } else if (is_last && !settings_.shade.transport.has_sky) {
      return false;
    }
    const core::SamplePair choice = walk.pair(core::Purpose::choice);
    std::optional<PlainWay> way = lobes.way(choice, walk.pair(core::Purpose::direction));
    if (!way || !survives(walk, static_cast<float>(choice.y), settings_.shade.transport.roulette_from, *way)) {
      return false;
    }
    const Vec3f start = plain_start(surface, way->towards);
    if (is_last) {
      const Color sky = core::sky_light(settings_.shade.transport, settings_.header.background, way->towards);
      light = light + (is_free(start, way->towards) ? walk.weight * way->weight * sky : Color{});
      return false;
    }
    go_on(walk, start, *way);
    return true;
  }

  void go_on(Walk& walk, const Vec3f& start, const PlainWay& way) const {
    walk.origin = start;
    walk.direction = way.towards;
    walk.weight = walk.weight * way.weight;
    walk.density = way.density;
    walk.is_scattered = walk.is_scattered || way.is_scattered || walk.depth == depth_max();
    ++walk.depth;
  }

  /// What point lights show: in tiny mirrors, too.
  Color points_on(const PlainSurface& surface, const PlainMaterial& material, const PlainLobes& lobes, const Vec3f& direction) {
    return material.has_microfacets()
               ? lights_on(surface, [&](const Vec3f& towards, float scale,
                                        float) { return lobes.response(towards * scale).value * std::numbers::pi_v<float>; })
               : lights_on(surface, material, direction);
  }

  /// What the one emitter shows that is drawn, if nothing lies before it.
  Color aimed_light(const Walk& walk, const PlainSurface& surface, const PlainLobes& lobes) {
    const std::optional<PlainAim> aim =
        plain_aim(stage(), surface.point, walk.pair(core::Purpose::emitter), walk.pair(core::Purpose::place));
    const PlainLobes::Response response = aim ? lobes.response(aim->towards) : PlainLobes::Response{};
    if (!(response.density > 0) || is_hidden(plain_start(surface, aim->towards), surface.point + aim->way)) {
      return {};
    }
    return aim->radiance * response.value * (way_share(aim->density, response.density) / aim->density);
  }

  Color light_beyond(const Walk& walk) const {
    const core::Transport& transport = settings_.shade.transport;
    return transport.has_sky   ? core::sky_light(transport, settings_.header.background, walk.direction)
           : walk.is_scattered ? Color{}
                               : settings_.header.background;
  }
  int depth_max() const { return settings_.shade.depth_max; }

  const core::RenderSettings& settings_;
  int ray_depth_max_;
};

PlainPicture PlainRenderer::render_paths(std::uint32_t thread_count) const {
  return painted<Walker>(*stage_, thread_count, [](Walker& walker, int x, int y) { return walker.mean_of(x, y); });
}

}  // namespace dmpc::apps

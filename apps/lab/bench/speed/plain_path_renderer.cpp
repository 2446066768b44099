#include "apps/lab/bench/speed/plain_path_renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/edge/line/number_text.h"
#include "apps/lab/bench/speed/plain_asker.h"
#include "apps/lab/bench/speed/plain_tiles.h"
#include "core/base/expect.h"
#include "core/picture/path_step.h"
#include "core/picture/sample_position.h"
#include "core/picture/surface_shares.h"

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
  bool is_scattered = false;  ///< by some surface before: it finds no backdrop

  core::SamplePair pair(core::Purpose purpose) const { return core::pair_of(pixel, sample, depth, purpose); }
};

/// One way in which a surface sends light on.
struct Way {
  Vec3f towards;
  Color weight;
  bool is_scattered = false;
};

/// What a ray meets behind the surface, by Snell's law.
struct Bend {
  float index, cosine, behind;

  Bend(const PlainMaterial& material, const PlainSurface& surface, const Vec3f& direction)
      : index(surface.is_leaving ? material.inside_index() : 1 / material.inside_index()),
        cosine(-dot(direction, surface.normal)),
        behind(1 - index * index * (1 - cosine * cosine)) {}
  bool is_total() const { return index > 1 && behind < 0; }
  Vec3f towards(const Vec3f& direction, const Vec3f& normal) const {
    return normalize(direction * index + normal * (index * cosine - std::sqrt(std::max(behind, 0.0F))));
  }
};

/// Below the surface nothing is scattered, wherever a blended normal points.
std::optional<Way> scattered(const PlainMaterial& material, const PlainSurface& surface, const Walk& walk, float chance) {
  const Vec3f towards(core::cosine_direction(walk.pair(core::Purpose::direction), core::Vec3d(surface.normal)));
  const float side = surface.is_leaving ? -1.0F : 1.0F;
  return side * dot(towards, surface.geometric_normal) > 0
             ? std::optional(Way{towards, material.color * (material.diffuse / chance), true})
             : std::nullopt;
}

/// Chosen in proportion to the brightest channels of all ways.
std::optional<Way> way_on(const PlainMaterial& material, const PlainSurface& surface, const Walk& walk) {
  const Bend bend(material, surface, walk.direction);
  const float total = bend.is_total() ? material.transmittance : 0;
  const Color mirror = material.highlight * material.mirror + Color{total, total, total};
  const float diffuse = brightest(material.color) * material.diffuse, mirrored = brightest(mirror);
  const float through = bend.is_total() ? 0 : material.transmittance, all = diffuse + mirrored + through;
  if (!(all > 0)) {
    return std::nullopt;
  }
  const auto place = static_cast<float>(walk.pair(core::Purpose::choice).x) * all;
  if (place < diffuse) {
    return scattered(material, surface, walk, diffuse / all);
  }
  if (place < diffuse + mirrored) {
    return Way{normalize(plain_mirrored(walk.direction, surface.normal)), mirror * (all / mirrored)};
  }
  return Way{bend.towards(walk.direction, surface.normal), Color{all, all, all}};
}

/// Whether the path survives roulette, and then counts for those that do not.
bool survives(const Walk& walk, int roulette_from, Way& way) {
  const float share = brightest(walk.weight * way.weight);
  if (walk.depth < roulette_from || share >= 1) {
    return share > 0;
  }
  way.weight = way.weight * (1 / share);
  return static_cast<float>(walk.pair(core::Purpose::choice).y) < share;
}

/// Of means.
constexpr double bias_max = 0.01;

/// The square of a mean's error, in all channels together, by what its two planes differ by, as if samples were independent.
double square_noise_of(const core::Film& film, std::uint32_t pixel) {
  const std::uint32_t samples = film.samples(pixel);
  const double on_first = core::samples_on(0, samples), on_second = core::samples_on(1, samples);
  const core::Vec3d apart = film.scaled_sum(pixel, 0) * (1 / on_first) - film.scaled_sum(pixel, 1) * (1 / on_second);
  return dot(apart, apart) / (film.scale().factor() * film.scale().factor()) / (1 / on_first + 1 / on_second) / samples;
}

}  // namespace

/// One thread at work.
class PlainPathRenderer::Walker : public PlainAsker {
 public:
  explicit Walker(const PlainStage& stage) : PlainAsker(stage), settings_(stage.settings()) {}

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
      light = light + walk.weight * material.emission;
      if (walk.depth > depth_max() || !step(walk, *surface, material, light)) {
        return light;
      }
    }
    return light + walk.weight * light_beyond(walk);
  }

  /// Shadow rays, and the way on; nothing more is to be found if this says no.
  bool step(Walk& walk, const PlainSurface& surface, const PlainMaterial& material, Color& light) {
    light = light + walk.weight * lights_on(surface, material, walk.direction);
    const bool is_last = walk.depth >= core::ray_depth_max(settings_.shade, settings_.header);
    if (is_last && !settings_.shade.transport.has_sky) {
      return false;
    }
    std::optional<Way> way = way_on(material, surface, walk);
    if (!way || !survives(walk, settings_.shade.transport.roulette_from, *way)) {
      return false;
    }
    const Vec3f start = plain_start(surface, way->towards);
    if (is_last) {
      const Color sky = core::sky_light(settings_.shade.transport, settings_.header.background, way->towards);
      light = light + (is_free(start, way->towards) ? walk.weight * way->weight * sky : Color{});
      return false;
    }
    walk.origin = start;
    walk.direction = way->towards;
    walk.weight = walk.weight * way->weight;
    walk.is_scattered = walk.is_scattered || way->is_scattered || walk.depth == depth_max();
    ++walk.depth;
    return true;
  }

  Color light_beyond(const Walk& walk) const {
    const core::Transport& transport = settings_.shade.transport;
    return transport.has_sky   ? core::sky_light(transport, settings_.header.background, walk.direction)
           : walk.is_scattered ? Color{}
                               : settings_.header.background;
  }
  int depth_max() const { return settings_.shade.depth_max; }

  const core::RenderSettings& settings_;
};

PlainPathRenderer::PlainPathRenderer(const Subject& subject)
    : stage_(std::make_unique<PlainStage>(subject, EmbreeMode::robust)) {}
PlainPathRenderer::~PlainPathRenderer() = default;

PlainPicture PlainPathRenderer::render(std::uint32_t thread_count) const {
  return painted<Walker>(*stage_, thread_count, [](Walker& walker, int x, int y) { return walker.mean_of(x, y); });
}

PathDistance path_distance(const PlainPicture& picture, const core::Film& film, const std::string& scene) {
  core::Vec3d ours, theirs;
  double apart = 0, noise = 0;
  for (std::uint32_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
    const core::Vec3d light = film.radiance(pixel), difference = core::Vec3d(picture.pixels[pixel]) - light;
    ours = ours + light;
    theirs = theirs + core::Vec3d(picture.pixels[pixel]);
    apart += dot(difference, difference);
    noise += square_noise_of(film, pixel);
  }
  const double count = 3.0 * static_cast<double>(picture.pixels.size());
  const PathDistance distance{std::sqrt(apart / count), std::sqrt(noise / count)};
  const core::Vec3d bias = theirs - ours;
  if (!(distance.apart <= path_distance_max * distance.noise) || !(dot(bias, bias) <= bias_max * bias_max * dot(ours, ours))) {
    throw core::InternalError("the plain path tracer's picture of " + scene + " lies " + fixed(255 * distance.apart, 2) +
                              "/255 from ours, root mean square, whose noise is " + fixed(255 * distance.noise, 2) +
                              "/255: expected half of that at most, and means that differ by a hundredth at most");
  }
  return distance;
}

}  // namespace dmpc::apps

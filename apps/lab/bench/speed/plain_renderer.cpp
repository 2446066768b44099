#include "apps/lab/bench/speed/plain_renderer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/embree_queries.h"
#include "apps/lab/bench/speed/plain_emitters.h"
#include "apps/lab/bench/speed/plain_lobes.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/lights/emitter_light.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/path_step.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/record/sky.h"

namespace dmpc::apps {

namespace {

using core::brightest;
using core::Color;
using core::Vec3f;

/// Limit for the difference of means, relative.
constexpr double bias_max = 0.01;

/// Returns the squared error of a mean, over all channels, from the difference of its two planes, as if samples were independent.
double square_noise_of(const core::Film& film, std::uint32_t pixel) {
  const std::uint32_t samples = film.samples(pixel);
  const double on_first = core::samples_on(0, samples), on_second = core::samples_on(1, samples);
  const core::Vec3d apart = film.scaled_sum(pixel, 0) * (1 / on_first) - film.scaled_sum(pixel, 1) * (1 / on_second);
  return dot(apart, apart) / (film.scale().factor() * film.scale().factor()) / (1 / on_first + 1 / on_second) / samples;
}

/// Works on rays in single precision, or in double where mirrors are curved, which multiply what rounding leaves.
template <class T>
class Painter : public EmbreeQueries {
 public:
  using EmbreeQueries::EmbreeQueries;
  using Vec = core::Vec3<T>;

  Color color(int x, int y) {
    return light_along(Vec(stage().camera().eye), stage().camera().towards(static_cast<T>(x), static_cast<T>(y)), 1);
  }

 private:
  Color light_along(const Vec& origin, const Vec& direction, int depth) {
    const std::optional<PlainSurface> surface = surface_along(origin, direction);
    if (!surface) {
      return stage().settings().header.background;
    }
    const PlainMaterial& material = stage().materials()[surface->material];
    Color light = material.emission + stage().settings().header.ambient * (material.color * material.diffuse) +
                  lights_on(*surface, material, Vec3f(direction));
    if (depth < stage().settings().shade.depth_max) {
      light = light + passed_on(*surface, material, direction, depth);
    }
    return light;
  }

  /// Returns the light from reflection and refraction.
  Color passed_on(const PlainSurface& surface, const PlainMaterial& material, const Vec& direction, int depth) {
    const Vec normal = surface.is_curved ? Vec(surface.exact_normal) : Vec(surface.normal);
    const T inside{material.inside_index()}, index = surface.is_leaving ? inside : 1 / inside, cosine = -dot(direction, normal);
    const T behind = 1 - index * index * (1 - cosine * cosine);
    const bool is_total = index > 1 && behind < 0;
    const float total = is_total ? material.transmittance : 0;
    const Color share = material.highlight * material.mirror + Color{total, total, total};
    Color light{};
    if (!(share == Color{})) {
      const Vec towards = normalize(plain_mirrored(direction, normal));
      light = light_along(plain_start(surface, towards), towards, depth + 1) * share;
    }
    if (!is_total && material.transmittance > 0) {
      const Vec bent = direction * index + normal * (index * cosine - std::sqrt(std::max(behind, T{})));
      const Vec towards = normalize(bent);
      light = light + light_along(plain_start(surface, towards), towards, depth + 1) * material.transmittance;
    }
    return light;
  }
};

struct Walk {
  std::uint32_t pixel, sample;
  Vec3f origin, direction;
  Color weight{1, 1, 1};
  int depth = 1;
  bool is_scattered = false;                               ///< a surface scattered it before: it finds no background
  float density = std::numeric_limits<float>::infinity();  ///< probability density of the direction

  core::SamplePair pair(core::Purpose purpose) const { return core::pair_of(pixel, sample, depth, purpose); }
};

/// Returns whether the path survives roulette; its weight then replaces those that do not.
bool survives(const Walk& walk, float chance, PlainWay& way) {
  const float share = brightest(walk.weight * way.weight);
  if (walk.depth < core::roulette_from || share >= 1) {
    return share > 0;
  }
  way.weight = way.weight * (1 / share);
  return chance < share;
}

/// Returns the weight of light found with density `own`, if another way might have found it with density `other`.
float way_share(float own, float other) { return static_cast<float>(core::way_share(double{own}, double{other})); }

class Walker : public EmbreeQueries {
 public:
  explicit Walker(const PlainStage& stage)
      : EmbreeQueries(stage),
        settings_(stage.settings()),
        ray_depth_max_(core::ray_depth_max(settings_.shade, settings_.header, settings_.skips)) {}

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
    return {.pixel = pixel, .sample = sample, .origin = Vec3f(stage().camera().eye), .direction = stage().camera().towards(x, y)};
  }

  Color light_of(Walk walk) {
    Color light{};
    while (const std::optional<PlainSurface> surface = surface_along(walk.origin, walk.direction)) {
      const PlainMaterial& material = stage().materials()[surface->material];
      light = light + walk.weight * material.emission * mis_weight(walk, *surface, material);
      if (walk.depth > depth_max() || !step(walk, *surface, material, light)) {
        return light;
      }
    }
    return light + walk.weight * light_beyond(walk);
  }

  /// Weight of a surface's emission in multiple importance sampling: the rest is the light sample of the previous hit.
  float mis_weight(const Walk& walk, const PlainSurface& surface, const PlainMaterial& material) const {
    const bool may_be_light_sampled = surface.material >= settings_.header.drawn_materials;
    return may_be_light_sampled && walk.density < std::numeric_limits<float>::infinity()
               ? way_share(walk.density, plain_bsdf_density(stage(), surface, walk.origin, walk.direction, material.emission))
               : 1;
  }

  /// Adds shadow rays, and continues the path; returns false if the path has ended.
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
    if (!way || !survives(walk, static_cast<float>(choice.y), *way)) {
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

  /// Returns the light of point lights, also reflected by microfacets.
  Color points_on(const PlainSurface& surface, const PlainMaterial& material, const PlainLobes& lobes, const Vec3f& direction) {
    return material.has_microfacets()
               ? lights_on(surface, [&](const Vec3f& towards, float scale,
                                        float) { return lobes.response(towards * scale).value * std::numbers::pi_v<float>; })
               : lights_on(surface, material, direction);
  }

  /// Returns the light of the sampled emitter, if nothing blocks it.
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

/// Renders with `thread_count` threads. Each takes the next tile when it has finished one, and calls its own Worker, made from
/// the stage, for each pixel: color(worker, column, row). Workers count rays().
template <class Worker, class Shade>
PlainPicture painted(const PlainStage& stage, std::uint32_t thread_count, const Shade& color) {
  const int width = stage.settings().camera.width(), height = stage.settings().camera.height();
  const int columns = core::ceil_divide(width, plain_tile_side), tiles = columns * core::ceil_divide(height, plain_tile_side);
  PlainPicture picture{.pixels = core::ZeroedArray<core::Color>(stage.settings().camera.pixel_count())};
  std::vector<std::uint64_t> rays(thread_count);
  std::atomic<int> next_tile = 0;
  on_threads(thread_count, [&](std::size_t thread) {
    Worker worker(stage);
    for (int tile = next_tile++; tile < tiles; tile = next_tile++) {
      const int left = tile % columns * plain_tile_side, top = tile / columns * plain_tile_side;
      for (int y = top; y < std::min(top + plain_tile_side, height); ++y) {
        for (int x = left; x < std::min(left + plain_tile_side, width); ++x) {
          picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
              color(worker, x, y);
        }
      }
    }
    rays[thread] = worker.rays();
  });
  picture.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return picture;
}

}  // namespace

PlainRenderer::PlainRenderer(const Subject& subject) : stage_(std::make_unique<PlainStage>(subject)) {
  core::expect(!core::has_sky_picture(subject.settings.header), "the plain renderer knows skies of colours alone, no pictures");
}
PlainRenderer::~PlainRenderer() = default;

const Times& PlainRenderer::build_times() const { return stage_->tree().build_times(); }

PlainPicture PlainRenderer::render(std::uint32_t thread_count) const {
  if (stage_->settings().shade.transport.is_by_paths()) {
    return painted<Walker>(*stage_, thread_count, [](Walker& walker, int x, int y) { return walker.mean_of(x, y); });
  }
  const auto color = [](auto& painter, int x, int y) { return painter.color(x, y); };
  return stage_->is_curved() ? painted<Painter<double>>(*stage_, thread_count, color)
                             : painted<Painter<float>>(*stage_, thread_count, color);
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

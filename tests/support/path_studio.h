// Pictures by paths of scenes whose light can be told on paper.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/picture/surfaces/transport.h"
#include "core/scene/frame.h"
#include "core/scene/scene.h"
#include "tests/support/film_of.h"

namespace dmpc::tests {

inline constexpr core::Transport paths{.kind = core::TransportKind::paths};

/// Pictures of a scene by the reference renderer. Light sampling of up to `emitters_max` emitters, by default none.
class Studio {
 public:
  explicit Studio(const core::Scene& scene, std::uint32_t emitters_max = 0)
      : scene_(scene), database_(core::build_database(scene, options_for(scene, emitters_max))) {}

  core::Film film(int side, int samples, const core::Transport& transport, int bounces, const core::Skips& skips = {}) const {
    operations = {};
    return film_of(database_, scene_.view, {transport, side, side, samples, bounces, skips}, operations);
  }
  /// The mean of the picture's light, in the red channel.
  double mean(int side, int samples, const core::Transport& transport, int bounces) const {
    return mean_of(film(side, samples, transport, bounces));
  }
  static double mean_of(const core::Film& film) {
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
      sum += film.radiance(pixel).x;
    }
    return sum / static_cast<double>(film.pixel_count());
  }
  /// The red channel of a square of pixels in the middle of a picture `times` as high: what they show does not depend on that,
  /// but their numbers do, and so all chances.
  std::vector<double> square(int side, int samples, int bounces, int times, const core::Transport& transport = paths) const {
    core::LocalRecords records(database_.bytes());
    core::GridTracer<core::LocalRecords> tracer(records, database_.header(), {});
    const PathPicture picture{transport, side, side * times, samples, bounces};
    const core::RenderSettings settings = picture.settings(database_, scene_.view);
    std::vector<core::HitState> stack(1);
    core::PixelTask task(stack);
    std::vector<double> light;
    const auto count = static_cast<std::uint32_t>(side * side), first = count * (static_cast<std::uint32_t>(times) / 2);
    for (std::uint32_t pixel = first; pixel < first + count; ++pixel) {
      const core::PixelSums sums = render_pixel(task, pixel, settings.first_samples(), tracer, settings, operations);
      light.push_back(static_cast<double>(sums.plane[0].channel[0] + sums.plane[1].channel[0]) * core::film_resolution / samples);
    }
    return light;
  }
  core::LocalRecords records() const { return core::LocalRecords(database_.bytes()); }
  /// Through the middle of the picture.
  core::Ray eye_ray() const { return core::Camera(scene_.view, frame(), 1, 1, 1).primary_ray(0, 0); }
  const core::DatabaseHeader& header() const { return database_.header(); }
  const core::GridFrame& frame() const { return database_.header().frame; }

  mutable core::Operations operations;  ///< for the last film

 private:
  static core::BuildOptions options_for(const core::Scene& scene, std::uint32_t emitters_max) {
    core::BuildOptions options = apps::several_macro_cells(scene);
    options.emitters_max = emitters_max;
    options.for_paths = true;
    return options;
  }

  core::Scene scene_;
  core::Database database_;
};

/// The error of the mean of pixels that are unlike by chance alone.
inline double standard_error(const core::Film& film) {
  const double mean = Studio::mean_of(film), count = static_cast<double>(film.pixel_count());
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    squares += (film.radiance(pixel).x - mean) * (film.radiance(pixel).x - mean);
  }
  return std::sqrt(squares / count / (count - 1));
}

/// No pixel, of one sample each, finds more light than may be found.
inline void check_bounded(const core::Film& film, double bound) {
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    CHECK(largest_component(film.radiance(pixel)) <= bound * (1 + 1e-6));
  }
}

inline core::Material grey(double albedo, double emission = 0) {
  return {.color = {albedo, albedo, albedo}, .diffuse = 1, .emission = {emission, emission, emission}};
}

inline void add_box(core::SceneBuilder& builder, const core::Vec3d& low, const core::Vec3d& high) {
  const auto corner = [&](int i) {
    return core::Vec3d{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  };
  for (const auto& face : {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    builder.polygon({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
  }
}

/// A closed room of this material, seen from inside.
inline core::Scene room(const core::Material& material, bool is_ball) {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.material(material);
  is_ball ? builder.sphere({0, 0, 0}, 2) : add_box(builder, {-1, -2, -1}, {2, 2, 1.5});
  scene.view = {.from = {0.2, 0.1, 0}, .at = {1, 2, 3}, .up = {0, 1, 0}, .angle_degrees = 80};
  return scene;
}

/// What a view of next to nothing shows: the floor at its origin, whose normal is z.
inline core::Scene seen_at_origin(core::Scene scene, const core::Vec3d& from) {
  scene.view = {.from = from, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 1e-3};
  return scene;
}

inline core::Scene floor_of(const core::Material& material, double half_side = 50) {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material(material);
  builder.polygon(
      {{-half_side, -half_side, 0}, {half_side, -half_side, 0}, {half_side, half_side, 0}, {-half_side, half_side, 0}});
  return scene;
}

inline double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double rmse(const std::vector<double>& picture, const std::vector<double>& reference) {
  double squares = 0;
  for (std::size_t pixel = 0; pixel < picture.size(); ++pixel) {
    squares += (picture[pixel] - reference[pixel]) * (picture[pixel] - reference[pixel]);
  }
  return std::sqrt(squares / static_cast<double>(picture.size()));
}

/// Pictures of one light: found by aiming at it and by meeting it by chance, weighed, and by either alone.
struct WaysToLight {
  std::vector<double> reference, both, aimed, met;

  /// They have one mean, and both vary little more than the better: its variance times `bar` at most.
  void check(double bar) const {
    const double root = std::sqrt(static_cast<double>(both.size()));
    for (const std::vector<double>* const way : {&both, &aimed, &met}) {
      CHECK(std::fabs(mean_of(*way) - mean_of(reference)) < 4 * (rmse(*way, reference) + rmse(both, reference) / 8) / root);
    }
    const double better = std::min(rmse(aimed, reference), rmse(met, reference));
    CHECK(rmse(both, reference) * rmse(both, reference) < bar * better * better);
  }
};

}  // namespace dmpc::tests

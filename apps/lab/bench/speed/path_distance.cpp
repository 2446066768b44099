#include "apps/lab/bench/speed/path_distance.h"

#include <cmath>

#include "apps/edge/line/number_text.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

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

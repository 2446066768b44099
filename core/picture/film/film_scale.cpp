#include "core/picture/film/film_scale.h"

#include <algorithm>
#include <cmath>

#include "core/picture/shade.h"

namespace dmpc::core {
namespace {

constexpr double multiplied_max = 0x1p20;
/// A sum saturates at 2 to this power.
constexpr int sum_exponent = 31;

/// The least integer whose power of 2 is greater than `value`.
int exponent_above(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent;
}

FilmScale scale_of(int exponent) { return {std::clamp(exponent, -FilmScale::exponent_max, FilmScale::exponent_max)}; }

}  // namespace

FilmScale film_scale_for(double radiance_bound, double bound_of_one_hit, std::uint32_t samples_max) {
  const double bound = std::min(radiance_bound, bound_of_one_hit * multiplied_max);
  if (!(bound > 0) || !std::isfinite(bound) || (bound >= unscaled_bound_min && bound <= unscaled_bound_max)) {
    return {};
  }
  return scale_of(bound < unscaled_bound_min ? -exponent_above(bound) : sum_exponent - exponent_above(bound * samples_max));
}

FilmScale film_scale_for(const Scene& scene, int depth_max, std::uint32_t samples_max, const Transport& transport) {
  // A ray from the eye is like a reflected one, one hit earlier.
  return film_scale_for(radiance_bound(scene, depth_max + 1, transport), radiance_bound(scene, 2, transport), samples_max);
}

}  // namespace dmpc::core

#include "apps/lab/bench/error/result.h"

#include <algorithm>
#include <cmath>

namespace dmpc::apps {

bool is_claimed(const SceneResult& result, const Measurement& measurement) {
  return measurement.error.root_mean_square >= 10 * result.reference.own_error;
}

std::optional<double> error_without_reference(const SceneResult& result, const Measurement& measurement) {
  const double all = measurement.error.root_mean_square, own = result.reference.own_error;
  return all > 2 * own ? std::optional(std::sqrt(all * all - own * own)) : std::nullopt;
}

ErrorInterval error_interval(const SceneResult& result, const Measurement& measurement) {
  const double all = measurement.error.root_mean_square, own = result.reference.own_error, least = all / 10;
  const auto without = [&](double reference) {
    return std::max(least, std::sqrt(std::max(0.0, all * all - reference * reference)));
  };
  return {.low = without(2 * own), .middle = without(own), .high = all};
}

std::optional<PictureError> deterministic_error(const SceneResult& result, std::size_t point) {
  switch (result.points[point].knob) {
    case Knob::cutoff:
    case Knob::depth:
    case Knob::tessellation:
      return result.of(point).deterministic;
    case Knob::arithmetic:
      return result.arithmetic;
    default:
      return std::nullopt;
  }
}

}  // namespace dmpc::apps

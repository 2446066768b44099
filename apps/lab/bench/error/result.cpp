#include "apps/lab/bench/error/result.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/expect.h"

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

namespace {

bool beats(const CostPoint& a, const CostPoint& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::map<double, double> by_error(std::span<const CostPoint> points) {
  std::map<double, double> costs;
  for (const CostPoint& point : points) {
    if (point.cost > 0 && point.error > 0) {
      const auto [at, is_new] = costs.emplace(point.error, point.cost);
      at->second = std::min(at->second, point.cost);
    }
  }
  return costs;
}

}  // namespace

std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_eligible) {
  core::expect(points.size() == is_eligible.size(), "every point is eligible or not");
  std::vector<bool> front = is_eligible;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t other = 0; other < points.size(); ++other) {
      front[i] = front[i] && !(is_eligible[other] && beats(points[other], points[i]));
    }
  }
  return front;
}

std::optional<double> cost_at(std::span<const CostPoint> points, double error) {
  const std::map<double, double> costs = by_error(points);
  const auto above = costs.lower_bound(error);
  if (above == costs.end() || (above == costs.begin() && above->first != error)) {
    return std::nullopt;
  }
  if (above->first == error) {
    return above->second;
  }
  const auto below = std::prev(above);
  const double share = std::log(error / below->first) / std::log(above->first / below->first);
  return below->second * std::pow(above->second / below->second, share);
}

}  // namespace dmpc::apps

#include "apps/lab/bench/error/result.h"

#include <cmath>
#include <map>
#include <numeric>

#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/sampling.h"

namespace dmpc::apps {

std::vector<double> square_errors(const Image& picture, const Reference& reference) {
  const auto square = [](double value) { return value * value; };
  std::vector<double> squares(pixel_groups);
  const std::size_t channels = picture.rgb.size();
  for (std::size_t i = 0; i < channels; ++i) {
    const double gap = double{picture.rgb[i]} - double{reference.picture.rgb[i]};
    squares[core::mix(i / 3) % pixel_groups] +=
        (square(gap) - square(double{reference.difference.rgb[i]})) / static_cast<double>(channels);
  }
  return squares;
}

double error_of(const Measurement& measurement, std::size_t left_out) {
  double sum = std::accumulate(measurement.squares.begin(), measurement.squares.end(), 0.0);
  if (left_out < pixel_groups) {
    sum = (sum - measurement.squares[left_out]) * pixel_groups / (pixel_groups - 1);
  }
  return std::sqrt(std::max(sum, 0.0));
}

bool is_told(const SceneResult& result, const Measurement& measurement) {
  const double error = error_of(measurement);
  return measurement.is_done() && std::isfinite(error) && error > 0 && error >= result.reference.own_error;
}

Estimate error_interval(const Measurement& measurement) {
  const double error = error_of(measurement), mean = error * error / pixel_groups;
  const double variance = core::sum_over<double>(measurement.squares, [&](const double square) {
    return (square - mean) * (square - mean) * pixel_groups / (pixel_groups - 1);
  });
  // Twice the deviation, and half of that for the root.
  const double factor = std::exp(std::sqrt(variance) / (error * error));
  return {.low = error / factor, .middle = error, .high = error * factor};
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

std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_drawn) {
  core::expect(points.size() == is_drawn.size(), "every point is drawn or not");
  std::vector<bool> front = is_drawn;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t other = 0; other < points.size(); ++other) {
      front[i] = front[i] && !(is_drawn[other] && beats(points[other], points[i]));
    }
  }
  return front;
}

std::optional<double> cost_at(std::span<const CostPoint> points, double error) {
  const std::map<double, double> costs = by_error(points);
  if (const auto same = costs.find(error); same != costs.end()) {
    return same->second;
  }
  if (costs.size() < 2 || error * curve_reach < costs.begin()->first || error > costs.rbegin()->first * curve_reach) {
    return std::nullopt;
  }
  auto above = costs.upper_bound(error);
  above = above == costs.begin() ? std::next(above) : above == costs.end() ? std::prev(above) : above;
  const auto below = std::prev(above);
  const double share = std::log(error / below->first) / std::log(above->first / below->first);
  return below->second * std::pow(above->second / below->second, share);
}

}  // namespace dmpc::apps

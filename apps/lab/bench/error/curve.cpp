#include "apps/lab/bench/error/curve.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

bool beats(const CostPoint& a, const CostPoint& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

/// The least cost by error.
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

// What a picture costs at a given error: points of a knob's curve, between them, and the front of all.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace dmpc::apps {

/// A measured render: what it took (rays, or seconds) and how far it is off. Both above 0 where logarithms are taken.
struct CostPoint {
  double cost = 0, error = 0;
};

/// Which points no other one is better than: none costs less or as much and has a smaller error, or the same error for less.
/// All of several points that are equal in both are on the front. Points with `is_eligible` false are not, and beat none.
std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_eligible);

/// The cost at which a curve through `points`, in any order, comes to `error`: on a straight line in the logarithms of both
/// between the two neighbours by error. Nothing outside the errors that there are. Points without cost or error are left out; of
/// several with one error the cheapest counts.
std::optional<double> cost_at(std::span<const CostPoint> points, double error);

}  // namespace dmpc::apps

// How fast something grows with something else: the exponent of a power law.
#pragma once

#include <optional>
#include <span>
#include <utility>

namespace dmpc::apps {

/// The slope of log y over log x by least squares: y grows as x to that power. Only points with both above 0 count; nothing
/// unless two of those differ in x. Points are (x, y).
std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points);

}  // namespace dmpc::apps

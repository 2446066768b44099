#include "apps/lab/study/systems/price_draws.h"

#include <algorithm>

namespace dmpc::apps {

AheadInDraws ahead_in(const std::vector<std::vector<double>>& seconds, std::size_t row, std::size_t other) {
  const auto count = std::count_if(seconds.begin(), seconds.end(), [&](const std::vector<double>& draw) {
    return outcome_of(draw[row], draw[other]) == Outcome::faster;
  });
  return {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(seconds.size())};
}

std::vector<std::uint32_t> first_in(const std::vector<std::vector<double>>& seconds) {
  std::vector<std::uint32_t> counts(seconds.empty() ? 0 : seconds.front().size(), 0);
  for (const std::vector<double>& draw : seconds) {
    for (std::size_t row = 0; row < draw.size(); ++row) {
      const auto is_behind = [&](double other) { return outcome_of(draw[row], other) == Outcome::faster; };
      counts[row] += std::count_if(draw.begin(), draw.end(), is_behind) == static_cast<std::ptrdiff_t>(draw.size()) - 1 ? 1 : 0;
    }
  }
  return counts;
}

}  // namespace dmpc::apps

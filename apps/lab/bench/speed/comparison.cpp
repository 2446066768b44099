#include "apps/lab/bench/speed/comparison.h"

#include <algorithm>

#include "apps/edge/table/averages.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::size_t Figures::rounds() const { return std::min(subject.size(), rival.size()); }

RatioSpread ratio_of(const Figures& figures) {
  std::vector<double> ratios(figures.rounds());
  for (std::size_t round = 0; round < ratios.size(); ++round) {
    core::expect(figures.rival[round] > 0, "a ratio is taken to a figure above 0");
    ratios[round] = figures.subject[round] / figures.rival[round];
  }
  core::expect(!ratios.empty(), "a comparison has been measured at least once");
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {median(ratios), *least, *most};
}

Comparison Comparison::once(double subject_figure, double rival_figure) const {
  Comparison measured = *this;
  measured.figures = {{subject_figure}, {rival_figure}};
  return measured;
}

Comparisons measured(std::span<const Comparison> comparisons, const std::function<bool(const Comparison&)>& is_meant) {
  Comparisons chosen;
  for (const Comparison& comparison : comparisons) {
    if (comparison.figures.rounds() > 0 && is_meant(comparison)) {
      chosen.push_back(&comparison);
    }
  }
  return chosen;
}

std::vector<Comparisons> grouped(const Comparisons& comparisons,
                                 const std::function<bool(const Comparison&, const Comparison&)>& are_alike) {
  std::vector<Comparisons> groups;
  for (const Comparison* const comparison : comparisons) {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const Comparisons& group) { return are_alike(*group.front(), *comparison); });
    (found == groups.end() ? groups.emplace_back() : *found).push_back(comparison);
  }
  return groups;
}

std::vector<double> ratios_of(const Comparisons& comparisons, Figures Comparison::*figures) {
  std::vector<double> ratios;
  for (const Comparison* const comparison : comparisons) {
    if ((comparison->*figures).rounds() > 0) {
      ratios.push_back(ratio_of(comparison->*figures).median);
    }
  }
  return ratios;
}

}  // namespace dmpc::apps

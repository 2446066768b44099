#include "apps/lab/bench/speed/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/frontend/table/averages.h"
#include "apps/frontend/table/rounds.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::size_t Figures::rounds() const { return std::min(subject.size(), baseline.size()); }

RatioSpread ratio_of(const Figures& figures) {
  std::vector<double> ratios(figures.rounds());
  for (std::size_t round = 0; round < ratios.size(); ++round) {
    core::expect(figures.baseline[round] > 0, "a ratio is taken to a figure above 0");
    ratios[round] = figures.subject[round] / figures.baseline[round];
  }
  core::expect(!ratios.empty(), "a comparison has been measured at least once");
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {median(ratios), *least, *most};
}

Comparison Comparison::once(double subject_figure, double baseline_figure) const {
  Comparison measured = *this;
  measured.figures = {{subject_figure}, {baseline_figure}};
  return measured;
}

Comparisons measured(std::span<const Comparison> comparisons) {
  Comparisons chosen;
  for (const Comparison& comparison : comparisons) {
    if (comparison.figures.rounds() > 0) {
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

std::size_t Matches::add(Measure measure) {
  contenders_.push_back(std::move(measure));
  return contenders_.size() - 1;
}

void Matches::compare(std::size_t subject, std::size_t baseline, Comparison comparison, std::size_t figure) {
  pairs_.push_back({subject, baseline, figure, results_.size()});
  results_.push_back(std::move(comparison));
}

void Matches::compare_timed(std::size_t subject, std::size_t baseline, Comparison comparison) {
  pairs_.push_back({subject, baseline, 1, results_.size(), &Comparison::processor});
  compare(subject, baseline, std::move(comparison));
}

void Matches::measure(std::size_t rounds, Progress& progress) {
  std::vector<std::vector<double>> figures(contenders_.size());  // this round's
  round_by_round(rounds, contenders_.size(), progress, [&](std::size_t contender) {
    figures[contender] = contenders_[contender]();
    for (const Pair& pair : pairs_) {
      if (pair.later() == contender) {
        const double subject = figures[pair.subject][pair.figure], baseline = figures[pair.baseline][pair.figure];
        if (!std::isnan(subject) && !std::isnan(baseline)) {
          Figures& compared = results_[pair.comparison].*pair.figures;
          compared.subject.push_back(subject);
          compared.baseline.push_back(baseline);
        }
      }
    }
  });
}

std::vector<double> figures_of(const Times& times) {
  constexpr double least_seconds = 1e-9;
  return {std::max(times.wall_seconds, least_seconds), std::max(times.processor_seconds, least_seconds)};
}

}  // namespace dmpc::apps

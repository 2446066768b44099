#include "apps/lab/bench/speed/matches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/edge/table/rounds.h"

namespace dmpc::apps {

std::size_t Matches::add(Measure measure) {
  contenders_.push_back(std::move(measure));
  return contenders_.size() - 1;
}

void Matches::compare(std::size_t subject, std::size_t rival, Comparison comparison, std::size_t figure) {
  pairs_.push_back({subject, rival, figure, results_.size()});
  results_.push_back(std::move(comparison));
}

void Matches::compare_timed(std::size_t subject, std::size_t rival, Comparison comparison, std::size_t figure) {
  pairs_.push_back({subject, rival, figure + 1, results_.size(), &Comparison::processor});
  compare(subject, rival, std::move(comparison), figure);
}

void Matches::measure(std::size_t rounds, Progress& progress) {
  std::vector<std::vector<double>> figures(contenders_.size());  // of the round
  round_by_round(rounds, contenders_.size(), progress, [&](std::size_t contender) {
    figures[contender] = contenders_[contender]();
    for (const Pair& pair : pairs_) {
      if (pair.later() == contender) {
        const double subject = figures[pair.subject][pair.figure], rival = figures[pair.rival][pair.figure];
        if (!std::isnan(subject) && !std::isnan(rival)) {
          Figures& compared = results_[pair.comparison].*pair.figures;
          compared.subject.push_back(subject);
          compared.rival.push_back(rival);
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

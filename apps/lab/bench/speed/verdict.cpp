#include "apps/lab/bench/speed/verdict.h"

#include <algorithm>
#include <cmath>

#include "apps/edge/line/number_text.h"

namespace dmpc::apps {
namespace {

Effect effect_of(double ratio) {
  return ratio >= 1 + win_share ? Effect::wins : ratio < 1 - loss_share ? Effect::loses : Effect::even;
}

/// A skip on all its scenes.
struct Summary {
  std::string name;
  std::string best_scene, worst_scene;
  double best = 0, worst = 1e9;  ///< ratios
  double error = 0;
  bool is_exact = true;

  void add(const Ablation& ablation) {
    const double ratio = verdict_on(ablation).ratio;
    if (ratio > best) {
      best = ratio;
      best_scene = ablation.seconds.scene;
    }
    if (ratio < worst) {
      worst = ratio;
      worst_scene = ablation.seconds.scene;
    }
    error = std::max(error, ablation.error.value_or(0));
    is_exact = ablation.is_exact();
  }
};

std::string sentence_about(const Summary& summary) {
  const bool wins = effect_of(summary.best) == Effect::wins, loses = effect_of(summary.worst) == Effect::loses;
  std::string sentence = summary.name + (wins && !loses ? ": kept, " : ": to be dropped, ");
  sentence += wins ? "wins up to " + percent_text(100 * (summary.best - 1)) + " (" + summary.best_scene + ")"
                   : "wins " + percent_text(100 * win_share) + " nowhere (at most " + percent_text(100 * (summary.best - 1)) +
                         ", " + summary.best_scene + ")";
  sentence += loses ? ", loses up to " + percent_text(100 * (1 - summary.worst)) + " (" + summary.worst_scene + ")"
                    : ", loses " + percent_text(100 * loss_share) + " nowhere";
  return sentence +
         (summary.is_exact ? "." : "; bounded, errs by up to " + fixed(255 * summary.error, 3) + "/255 (root mean square).");
}

}  // namespace

AblationVerdict verdict_on(const Ablation& ablation) {
  const RatioSpread times = ratio_of(ablation.seconds);
  const double doubt = std::max(times.most - times.least, ablation.noise);
  const bool is_clear =
      effect_of(times.least) == effect_of(times.most) && doubt <= std::max(loss_share, std::fabs(times.median - 1));
  const double ratio = is_clear ? times.median : ablation.work_ratio;
  return {effect_of(ratio), !is_clear, ratio};
}

std::string text_of(const AblationVerdict& verdict) {
  const std::string effect = verdict.effect == Effect::wins ? "wins" : verdict.effect == Effect::loses ? "loses" : "even";
  return effect + (verdict.is_by_work ? " (work)" : " (time)");
}

std::vector<std::string> verdicts_on(std::span<const Ablation> ablations) {
  std::vector<Summary> summaries;
  for (const Ablation& ablation : ablations) {
    if (!ablation.avoided) {
      continue;
    }
    const auto is_same = [&](const Summary& summary) { return summary.name == ablation.seconds.what; };
    auto found = std::find_if(summaries.begin(), summaries.end(), is_same);
    found = found == summaries.end() ? summaries.insert(found, {.name = ablation.seconds.what}) : found;
    found->add(ablation);
  }
  std::vector<std::string> sentences(summaries.size());
  std::transform(summaries.begin(), summaries.end(), sentences.begin(), sentence_about);
  return sentences;
}

}  // namespace dmpc::apps

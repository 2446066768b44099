#include "apps/lab/bench/speed/smallest_item.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

struct Cost {
  double work_us, ratio;
};

std::vector<Cost> costs_of(const Comparisons& group) {
  std::vector<Cost> costs;
  for (const Comparison* const one : group) {
    costs.push_back({median(one->rival_figures), ratio_of(*one).median});
  }
  std::sort(costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.work_us < b.work_us; });
  return costs;
}

std::string microseconds(double us) { return fixed(us, us < 10 ? 1 : 0) + " us"; }

double crossing(const Cost& before, const Cost& behind) {
  const double share = (before.ratio - item_cost_max) / (before.ratio - behind.ratio);
  return before.work_us * std::pow(behind.work_us / before.work_us, share);
}

std::string smallest_of(const std::vector<Cost>& costs) {
  const auto dear = std::find_if(costs.rbegin(), costs.rend(), [](const Cost& cost) { return cost.ratio > item_cost_max; });
  if (dear == costs.rend()) {
    return "less than " + microseconds(costs.front().work_us);
  }
  return dear == costs.rbegin() ? "more than " + microseconds(dear->work_us) : microseconds(crossing(*dear, *std::prev(dear)));
}

}  // namespace

std::vector<std::string> smallest_items(std::span<const Comparison> comparisons) {
  const Comparisons items = measured(comparisons, [](const Comparison& one) { return one.what == item_comparison; });
  std::vector<std::string> sentences;
  for (const Comparisons& group : grouped(items, [](const auto&a, const auto&b) { return a.subject == b.subject; })) {
    const std::vector<Cost> costs = costs_of(group);
    sentences.push_back("Smallest work an item at which " + group.front()->subject + " cost " + fixed(item_cost_max, 1) +
                        " times the work alone, processor time: " + smallest_of(costs) + " (" + fixed(costs.front().ratio, 1) +
                        " times with " + microseconds(costs.front().work_us) + ", " + fixed(costs.back().ratio, 2) + " with " +
                        microseconds(costs.back().work_us) + ").");
  }
  return sentences;
}

}  // namespace dmpc::apps

#include "apps/lab/bench/speed/kernel_means.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

using Comparisons = std::vector<std::reference_wrapper<const Comparison>>;
using Key = std::string (*)(const Comparison&);

/// With equal keys, in the order in which the keys come first.
std::vector<Comparisons> grouped_by(Key key, const Comparisons& comparisons) {
  std::vector<Comparisons> groups;
  for (const Comparison& comparison : comparisons) {
    const auto is_same = [&](const Comparisons& group) { return key(group.front()) == key(comparison); };
    const auto found = std::find_if(groups.begin(), groups.end(), is_same);
    (found == groups.end() ? groups.emplace_back() : *found).push_back(comparison);
  }
  return groups;
}

std::string mean_text(const Comparisons& comparisons) {
  std::vector<double> ratios(comparisons.size());
  std::transform(comparisons.begin(), comparisons.end(), ratios.begin(),
                 [](const Comparison& one) { return ratio_of(one).median; });
  return fixed(*geometric_mean(ratios), 3);
}

/// "primary 0.42, shadow 0.3": each group by its key, with commas between.
std::string listed(Key key, const Comparisons& comparisons, std::string (*text)(const Comparisons&)) {
  std::string list;
  for (const Comparisons& group : grouped_by(key, comparisons)) {
    list += (list.empty() ? "" : ", ") + key(group.front()) + " " + text(group);
  }
  return list;
}

std::string detail_of(const Comparison& comparison) { return comparison.detail; }
std::string query_of(const Comparison& comparison) { return comparison.what; }
std::string pair_of(const Comparison& comparison) {
  return comparison.subject + " over " + comparison.rival + ", threads: " + std::to_string(comparison.threads);
}

std::string query_text(const Comparisons& comparisons) {
  return mean_text(comparisons) + " (" + listed(detail_of, comparisons, mean_text) + ")";
}

}  // namespace

std::vector<std::string> kernel_means(std::span<const Comparison> comparisons) {
  Comparisons measured;
  std::copy_if(comparisons.begin(), comparisons.end(), std::back_inserter(measured),
               [](const Comparison& one) { return one.part == SpeedPart::kernel && one.rounds() > 0; });
  std::vector<std::string> sentences;
  for (const Comparisons& pair : grouped_by(pair_of, measured)) {
    sentences.push_back(pair_of(pair.front()) + "; " + listed(query_of, pair, query_text) + ".");
  }
  return sentences;
}

}  // namespace dmpc::apps

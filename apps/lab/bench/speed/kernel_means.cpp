#include "apps/lab/bench/speed/kernel_means.h"

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

using Key = std::string (*)(const Comparison&);

std::vector<Comparisons> grouped_by(Key key, const Comparisons& comparisons) {
  return grouped(comparisons, [&](const Comparison& a, const Comparison& b) { return key(a) == key(b); });
}

std::string mean_text(const Comparisons& comparisons) { return fixed(*geometric_mean(ratios_of(comparisons)), 3); }

/// "primary 0.42, shadow 0.3": each group by its key, with commas between.
std::string listed(Key key, const Comparisons& comparisons, std::string (*text)(const Comparisons&)) {
  std::string list;
  for (const Comparisons& group : grouped_by(key, comparisons)) {
    list += (list.empty() ? "" : ", ") + key(*group.front()) + " " + text(group);
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
  const auto is_kernel = [](const Comparison& one) { return one.part == SpeedPart::kernel; };
  std::vector<std::string> sentences;
  for (const Comparisons& pair : grouped_by(pair_of, measured(comparisons, is_kernel))) {
    sentences.push_back(pair_of(*pair.front()) + "; " + listed(query_of, pair, query_text) + ".");
  }
  return sentences;
}

}  // namespace dmpc::apps

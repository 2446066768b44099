#include "apps/lab/bench/speed/headline.h"

#include <algorithm>
#include <vector>

#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

/// Comparisons that differ in scene and kind alone.
struct Group {
  const Comparison* first;
  std::vector<double> ratios;
};

bool is_shown(const Comparison& comparison) {
  const bool is_timed = comparison.part == SpeedPart::picture || comparison.part == SpeedPart::emulation;
  return comparison.part != SpeedPart::plain && comparison.rounds() > 0 && (!is_timed || comparison.is_by_wall_clock());
}

bool are_alike(const Comparison& a, const Comparison& b) {
  return a.part == b.part && a.what == b.what && a.threads == b.threads && a.subject == b.subject && a.rival == b.rival;
}

std::vector<Group> groups_of(std::span<const Comparison> comparisons) {
  std::vector<Group> groups;
  for (const Comparison& comparison : comparisons) {
    if (!is_shown(comparison)) {
      continue;
    }
    auto found =
        std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return are_alike(*group.first, comparison); });
    found = found == groups.end() ? groups.insert(found, {&comparison, {}}) : found;
    found->ratios.push_back(ratio_of(comparison).median);
  }
  return groups;
}

}  // namespace

Table headline_of(std::span<const Comparison> comparisons, const std::string& title) {
  Table table(title, {{"part"},
                      {"what"},
                      {"threads or nodes"},
                      {"subject"},
                      {"rival"},
                      {"ratio", "", 3},
                      {"least", "", 3},
                      {"most", "", 3},
                      {"of"}});
  for (const Group& group : groups_of(comparisons)) {
    const Comparison& one = *group.first;
    const auto [least, most] = std::minmax_element(group.ratios.begin(), group.ratios.end());
    table.add_row({std::string(name_of(one.part)), one.what, one.threads == 0 ? Cell() : Cell(std::uint64_t{one.threads}),
                   one.subject, one.rival, *least > 0 ? Cell(*geometric_mean(group.ratios)) : Cell(), *least, *most,
                   std::uint64_t{group.ratios.size()}});
  }
  return table;
}

}  // namespace dmpc::apps

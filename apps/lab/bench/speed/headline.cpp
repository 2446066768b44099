#include "apps/lab/bench/speed/headline.h"

#include <algorithm>
#include <vector>

#include "apps/edge/table/averages.h"

namespace dmpc::apps {
namespace {

bool is_shown(const Comparison& comparison) {
  const bool is_timed = comparison.part == SpeedPart::picture || comparison.part == SpeedPart::emulation;
  return comparison.part != SpeedPart::plain && (!is_timed || comparison.is_by_wall_clock());
}

bool are_alike(const Comparison& a, const Comparison& b) {
  return a.part == b.part && a.what == b.what && a.threads == b.threads && a.subject == b.subject && a.rival == b.rival;
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
  for (const Comparisons& group : grouped(measured(comparisons, is_shown), are_alike)) {
    const Comparison& one = *group.front();
    const std::vector<double> ratios = ratios_of(group);
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    table.add_row({std::string(name_of(one.part)), one.what, one.threads == 0 ? Cell() : Cell(std::uint64_t{one.threads}),
                   one.subject, one.rival, *least > 0 ? Cell(*geometric_mean(ratios)) : Cell(), *least, *most,
                   std::uint64_t{ratios.size()}});
  }
  return table;
}

}  // namespace dmpc::apps

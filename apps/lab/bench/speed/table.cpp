#include "apps/lab/bench/speed/comparison.h"

#include <algorithm>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/averages.h"
#include "apps/frontend/table/filled_columns.h"

namespace dmpc::apps {
namespace {

/// Returns the median of the rounds that both have finished; nothing if there is none.
Cell median_of(const Figures& figures, std::vector<double> Figures::*whose) {
  const std::vector<double>& all = figures.*whose;
  return figures.rounds() == 0 ? Cell()
                               : Cell(median({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(figures.rounds())}));
}

const FilledColumns<Comparison>& comparison_columns() {
  using C = Comparison;
  using F = Figures;
  static const FilledColumns<C> columns = {
      {{"part"}, [](const C& c) { return name_of(c.part); }},
      {{"scene"}, &C::scene},
      {{"what"}, &C::what},
      {{"detail"}, &C::detail},
      {{"threads or nodes"}, [](const C& c) { return c.threads == 0 ? Cell() : Cell(std::uint64_t{c.threads}); }},
      {{"subject"}, &C::subject},
      {{"baseline"}, &C::baseline},
      {{"unit"}, &C::unit},
      {{"subject's figure", "", 4}, [](const C& c) { return median_of(c.figures, &F::subject); }},
      {{"baseline's figure", "", 4}, [](const C& c) { return median_of(c.figures, &F::baseline); }},
      {{"ratio", "", 3}, [](const C& c) { return ratio_of(c.figures).median; }},
      {{"least ratio", "", 3}, [](const C& c) { return ratio_of(c.figures).least; }},
      {{"largest ratio", "", 3}, [](const C& c) { return ratio_of(c.figures).most; }},
      {{"subject's processor time", "s", 4}, [](const C& c) { return median_of(c.processor, &F::subject); }},
      {{"baseline's processor time", "s", 4}, [](const C& c) { return median_of(c.processor, &F::baseline); }},
      {{"ratio in processor time", "", 3},
       [](const C& c) { return c.processor.rounds() > 0 ? Cell(ratio_of(c.processor).median) : Cell(); }},
      {{"rounds"}, [](const C& c) { return std::uint64_t{c.figures.rounds()}; }}};
  return columns;
}

bool are_alike(const Comparison& a, const Comparison& b) {
  return a.part == b.part && a.what == b.what && a.threads == b.threads && a.subject == b.subject && a.baseline == b.baseline;
}

Cell mean_of(const std::vector<double>& ratios) {
  const bool is_there = !ratios.empty() && *std::min_element(ratios.begin(), ratios.end()) > 0;
  return is_there ? Cell(*geometric_mean(ratios)) : Cell();
}

/// Returns "primary 0.423, shadow 0.312"; empty if all are of one kind.
std::string means_by_kind(const Comparisons& group) {
  const auto kinds = grouped(group, [](const Comparison& a, const Comparison& b) { return a.detail == b.detail; });
  std::string text;
  for (const Comparisons& kind : kinds) {
    text += (text.empty() ? "" : ", ") + kind.front()->detail + " " + fixed(geometric_mean(ratios_of(kind)).value_or(0), 3);
  }
  return kinds.size() > 1 ? text : "";
}

}  // namespace

Table headline_of(std::span<const Comparison> comparisons, const std::string& title, bool all) {
  Table table(title, {{"part"},
                      {"what"},
                      {"threads or nodes"},
                      {"subject"},
                      {"baseline"},
                      {"ratio", "", 3},
                      {"least", "", 3},
                      {"most", "", 3},
                      {"in processor time", "", 3},
                      {"of"},
                      {"by kind"}});
  for (const Comparisons& group : grouped(measured(comparisons), are_alike)) {
    const Comparison& one = *group.front();
    if (!all && !one.is_main) {
      continue;
    }
    const std::vector<double> ratios = ratios_of(group);
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    table.add_row({std::string(name_of(one.part)), one.what, one.threads == 0 ? Cell() : Cell(std::uint64_t{one.threads}),
                   one.subject, one.baseline, mean_of(ratios), *least, *most, mean_of(ratios_of(group, &Comparison::processor)),
                   std::uint64_t{ratios.size()}, means_by_kind(group)});
  }
  return table;
}

Table table_of(std::span<const Comparison> comparisons, const std::string& title) {
  Table table(title, heads_of(comparison_columns()));
  for (const Comparison* const comparison : measured(comparisons)) {
    table.add_row(row_of(comparison_columns(), *comparison));
  }
  return table;
}

}  // namespace dmpc::apps

// A table of the options that only some strategies have.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "apps/frontend/run/option_row.h"
#include "apps/frontend/run/option_words.h"
#include "apps/run/strategy_options.h"
#include "dataflow/plan.h"
#include "svm/plan.h"

namespace dmpc::apps {

using PageRow = OptionRow<svm::PageOptions, svm::Plan>;
using BalanceRow = OptionRow<dataflow::BalanceOptions, dataflow::Plan>;
using RayRow = OptionRow<dataflow::RayOptions, dataflow::Plan>;

/// dmpc's own replacement policies.
OptionSet::Choices<svm::Replacement> policy_choices();

/// In the order of the help.
const std::vector<PageRow>& page_rows();
const std::vector<BalanceRow>& balance_rows();
const std::vector<RayRow>& ray_rows();

/// Returns the strategy if it is one in which pixels stay on their nodes; nullptr for dataflow.
const svm::Strategy* page_strategy(Strategy strategy);
/// Returns whether a strategy has the row's field.
bool has(Strategy strategy, const PageRow& row);
template <class Options>
bool has(Strategy strategy, const OptionRow<Options, dataflow::Plan>&) {
  return strategy == Strategy::dataflow;
}

/// Calls visit(row) for each option that only some strategies have.
template <class Visit>
void for_each_row(const Visit& visit) {
  std::for_each(page_rows().begin(), page_rows().end(), visit);
  std::for_each(balance_rows().begin(), balance_rows().end(), visit);
  std::for_each(ray_rows().begin(), ray_rows().end(), visit);
}

/// Returns the option words of all plan fields, for with_options_named().
const std::vector<OptionWord>& strategy_words();

/// A key of --stats and its description in the schema.
struct ReportedKey {
  std::string_view key;
  OptionKind kind;
  std::string_view meaning;
};
/// In the order of --stats.
std::vector<ReportedKey> reported_keys();

/// A key of --stats and its value.
struct ReportedOption {
  std::string_view key;
  OptionValue value;
};
/// Like reported_keys(); values are null except for the options of the plan's strategy.
std::vector<ReportedOption> reported_options(Strategy strategy, const svm::Plan& plan);
std::vector<ReportedOption> reported_options(Strategy strategy, const dataflow::Plan& plan);

}  // namespace dmpc::apps

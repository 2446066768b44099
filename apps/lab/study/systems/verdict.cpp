#include "apps/lab/study/systems/verdict.h"

#include <cmath>
#include <utility>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

const std::string& value_in(const ComparedRow& row, const std::string& option) {
  static const std::string none;
  const auto found = row.options.find(option);
  return found == row.options.end() ? none : found->second;
}

std::string text_of(const OptionDifference& one) {
  const auto value = [](const std::string& text) { return text.empty() ? std::string("none") : text; };
  return one.option + " (" + value(one.first) + ", " + value(one.second) + ")";
}

/// "; svm on extents alone has homes spread, in-flight 64".
std::string own_text(const ComparedRow& row, const ComparedRow& other) {
  std::string text;
  for (const auto& [option, value] : row.options) {
    if (!other.options.contains(option)) {
      text += (text.empty() ? "; " + row.name + " alone has " : ", ") + option + " " + value;
    }
  }
  return text;
}

}  // namespace

std::vector<OptionDifference> differences(const ComparedRow& first, const ComparedRow& second) {
  std::map<std::string, std::string> names = first.options;
  names.insert(second.options.begin(), second.options.end());
  std::vector<OptionDifference> all;
  for (const auto& [option, value] : names) {
    const std::string &one = value_in(first, option), &other = value_in(second, option);
    if (one != other) {
      all.push_back({option, one, other});
    }
  }
  return all;
}

Outcome outcome_of(double first_seconds, double second_seconds) {
  if (std::abs(first_seconds - second_seconds) <= time_tie_share * second_seconds) {
    return Outcome::tie;
  }
  return first_seconds < second_seconds ? Outcome::faster : Outcome::slower;
}

std::string VerdictOnRows::times_text() const {
  const Circumstances& shared = circumstances();
  const double ratio = second_.seconds / first_.seconds;
  return counted(shared.node_count, "node") + " of " + shared.machine + ", " +
         (shared.memory_bytes ? bytes_text(*shared.memory_bytes) + " each" : "as much memory as each needs") + ": " +
         first_.name + " " + amount_text(first_.seconds, "s") + ", " + second_.name + " " + amount_text(second_.seconds, "s") +
         (outcome() == Outcome::tie ? ", a tie" : ", " + fixed(ratio, 2) + " times as long");
}

bool IsolatedVerdict::may_compare(const ComparedRow& first, const ComparedRow& second) {
  return first.circumstances == second.circumstances && differences(first, second).size() == 1;
}

IsolatedVerdict::IsolatedVerdict(ComparedRow first, ComparedRow second) : VerdictOnRows(std::move(first), std::move(second)) {
  core::expect(may_compare(this->first(), this->second()), "an isolated verdict is about runs that differ in one option");
  difference_ = differences(this->first(), this->second()).front();
}

std::string IsolatedVerdict::sentence() const { return "Isolated, " + text_of(difference_) + " alone, " + times_text() + "."; }

BestVerdict::BestVerdict(ComparedRow first, ComparedRow second, std::optional<AheadInDraws> ahead)
    : VerdictOnRows(std::move(first), std::move(second)), ahead_(ahead) {
  core::expect(circumstances() == this->second().circumstances, "the best are compared in the same circumstances");
  core::expect(!this->first().search.empty() && this->first().search == this->second().search,
               "the best are compared if the same search has found them");
}

std::string BestVerdict::sentence() const {
  std::string text = std::string(opening) + (is_undecided() ? ", undecided, " : ", ") + times_text();
  if (ahead_) {
    text += "; ahead in " + std::to_string(ahead_->count) + " of " + std::to_string(ahead_->draws) + " draws of the prices";
  }
  std::vector<std::string> of_both;
  for (const OptionDifference& one : differences(first(), second())) {
    if (!one.first.empty() && !one.second.empty()) {
      of_both.push_back(text_of(one));
    }
  }
  return text + ". They differ in " + joined(of_both, ", ") + own_text(first(), second()) + own_text(second(), first()) + ".";
}

}  // namespace dmpc::apps

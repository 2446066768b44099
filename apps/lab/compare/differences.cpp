#include "apps/lab/compare/differences.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "apps/frontend/line/option_values.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {
namespace {

using Values = std::unordered_map<std::string, FigureValue>;

Values values_of(std::span<const Figure> figures) {
  Values values;
  for (const Figure& figure : figures) {
    values.emplace(figure.name, figure.value);
  }
  return values;
}

/// Returns "heat_maps.0" for "heat_maps.0.clock".
std::string parent_of(const std::string& name) { return name.substr(0, name.rfind('.')); }

/// Returns keys of figures that differ from run to run, or that depend on how a run was requested.
std::vector<std::string> unsteady_keys(std::span<const Figure> figures) {
  std::vector<std::string> keys = {"program",          "seconds",      "nodes.*.seconds",     "host.seconds",
                                   "heat_maps.*.file", "ranks.*.name", "ranks.*.clock_error", "sandbox"};
  for (const Figure& figure : figures) {
    if (is_within(figure.name, "heat_maps.*.clock") && text_of(figure.value) == "processor time") {
      keys.push_back(parent_of(figure.name));
    }
  }
  return keys;
}

bool is_within_any(const std::string& name, const std::vector<std::string>& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return is_within(name, key); });
}

bool is_near(const FigureValue& value, const FigureValue& reference, double share) {
  const std::optional<double> number = number_of(value), right = number_of(reference);
  return number && right && std::abs(*number - *right) <= share * std::abs(*right);
}

/// Which of two runs' figures are compared, and how.
class Judge {
 public:
  Judge(std::span<const Figure> figures, std::span<const Figure> reference, const FigureChoice& choice)
      : values_(values_of(figures)), references_(values_of(reference)), choice_(choice) {
    for (const std::span<const Figure> side : {reference, figures}) {
      const std::vector<std::string> keys = unsteady_keys(side);
      unsteady_.insert(unsteady_.end(), keys.begin(), keys.end());
    }
  }

  /// Compares a figure of either file; a figure of both is visited once.
  void look_at(const std::string& name, FigureComparison& result) const {
    if (!is_chosen(name)) {
      return;
    }
    ++result.compared;
    const auto value = found(values_, name), reference = found(references_, name);
    const Tolerance* const tolerance = tolerance_of(name);
    if (value != reference && !(value && reference && tolerance != nullptr && is_near(*value, *reference, tolerance->share))) {
      result.differences.push_back({name, value, reference});
    }
  }
  bool has_reference(const std::string& name) const { return references_.contains(name); }

 private:
  static std::optional<FigureValue> found(const Values& values, const std::string& name) {
    const auto at = values.find(name);
    return at == values.end() ? std::nullopt : std::optional(at->second);
  }
  /// Returns the last given tolerance that includes the figure; null if none does.
  const Tolerance* tolerance_of(const std::string& name) const {
    const auto at = std::find_if(choice_.tolerances.rbegin(), choice_.tolerances.rend(),
                                 [&](const Tolerance& tolerance) { return is_within(name, tolerance.key); });
    return at == choice_.tolerances.rend() ? nullptr : &*at;
  }
  bool is_chosen(const std::string& name) const {
    const bool is_asked_for = choice_.only.empty() || is_within_any(name, choice_.only);
    return is_asked_for && (tolerance_of(name) != nullptr || !is_within_any(name, unsteady_));
  }

  Values values_, references_;
  const FigureChoice& choice_;
  std::vector<std::string> unsteady_;
};

void check_key(const std::string& option, const std::string& key, std::span<const Figure> figures,
               std::span<const Figure> reference) {
  std::vector<std::string> names;
  for (const std::span<const Figure> side : {figures, reference}) {
    for (const Figure& figure : side) {
      if (is_within(figure.name, key)) {
        return;
      }
      names.push_back(figure.name);
    }
  }
  throw core::InputError(option + "=" + key + ": neither file has a figure there; expected keys with dots between, such as " +
                         "pages.faults or nodes.*.pages." + core::did_you_mean(key, names));
}

}  // namespace

Tolerance parse_tolerance(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const double share = colon == std::string::npos ? amount_in("") : amount_in(text.substr(colon + 1));
  if (colon == 0 || !(share >= 0)) {
    throw core::UsageError("--tolerance=" + text +
                           ": expected keys with dots between, a colon and a share from 0 on, such as pages.faults:0.05");
  }
  return {text.substr(0, colon), share};
}

FigureComparison compare_figures(std::span<const Figure> figures, std::span<const Figure> reference, const FigureChoice& choice) {
  for (const std::string& key : choice.only) {
    check_key("--only", key, figures, reference);
  }
  for (const Tolerance& tolerance : choice.tolerances) {
    check_key("--tolerance", tolerance.key, figures, reference);
  }
  const Judge judge(figures, reference, choice);
  FigureComparison result;
  for (const Figure& figure : reference) {
    judge.look_at(figure.name, result);
  }
  for (const Figure& figure : figures) {
    if (!judge.has_reference(figure.name)) {
      judge.look_at(figure.name, result);
    }
  }
  return result;
}

}  // namespace dmpc::apps

#include "apps/lab/compare/limit.h"

#include <algorithm>
#include <array>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

constexpr std::array<Measure, 8> measures = {{
    {"rmse", [](const PictureError& error) { return error.root_mean_square; }},
    {"max", [](const PictureError& error) { return error.largest; }},
    {"p99", [](const PictureError& error) { return error.percentile_99; }},
    {"mae", [](const PictureError& error) { return error.mean_absolute; }},
    {"relmse", [](const PictureError& error) { return error.relative_mean_square; }},
    {"flip", [](const PictureError& error) { return error.flip_mean; }},
    {"flip-p99", [](const PictureError& error) { return error.flip_percentile_99; }},
    {"pixels", [](const PictureError& error) { return static_cast<double>(error.differing_pixels); }},
}};

const Measure* find_measure(const std::string& name) { return core::find_in(measures, name, &Measure::name); }

std::vector<std::string> all_names() { return core::mapped<std::string>(measures, &Measure::name); }

}  // namespace

std::string measure_names() { return joined(all_names(), "|"); }

Limit parse_limit(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon), amount = colon == std::string::npos ? "" : text.substr(colon + 1);
  const Limit limit{find_measure(name), amount_in(amount), amount};
  if (limit.measure == nullptr || !(limit.most >= 0)) {
    const std::string meant = limit.measure == nullptr ? core::did_you_mean(name, all_names()) : "";
    throw core::UsageError("--fail-above=" + text + ": expected " + measure_names() +
                           ", a colon and a number from 0 on, such as rmse:1/255" + (meant.empty() ? "" : ".") + meant);
  }
  return limit;
}

std::vector<std::string> passed_limits(const std::vector<Limit>& limits, const PictureError& error) {
  std::vector<std::string> passed;
  for (const Limit& limit : limits) {
    const double value = limit.measure->of(error);
    if (!(value <= limit.most)) {
      passed.push_back(std::string(limit.measure->name) + " " + rounded(value) + " is above " + limit.text);
    }
  }
  return passed;
}

}  // namespace dmpc::apps

#include "apps/show/page/forecast_view.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <variant>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/run_view.h"
#include "apps/frontend/show/page/shares.h"
#include "apps/frontend/table/table.h"
#include "apps/run/report.h"
#include "core/base/ranges.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;

constexpr double reported_error_least = 0.001;  ///< smaller errors are not reported

std::string why_wide(const CacheForecast& forecast, bool is_of_time) {
  std::string text = is_of_time ? "The band lies between two readings of that run: that all of its time except computing grows "
                                  "with the faults, or only page wait, service of interrupts and messages."
                                : "";
  if (forecast.curve_error >= reported_error_least) {
    text += " It is wider by " + share_text(forecast.curve_error) +
            ", by which the curve misses that run's own faults, as several pixels wait for one page, the policy is not lru, or "
            "the curve is from a sample.";
  }
  if (forecast.sample_error > 0) {
    text += " It is wider by up to " + share_text(forecast.sample_error) +
            " of the faults on each side, since the curve is from a sample, one page in " + std::to_string(forecast.every) + ".";
  }
  return text;
}

double milliseconds(double ns) { return ns / 1e6; }

std::set<std::uint32_t> sizes_of(const ForecastView& view) {
  std::set<std::uint32_t> sizes = {view.cache_pages};
  for (const TimeBand& size : view.sizes) {
    sizes.insert(size.cache_pages);
  }
  return sizes;
}

Table forecast_table(const ForecastView& view) {
  Table table(
      "Run time by the size of the caches",
      {{"cache", "pages", 0}, {"faults", "", 0}, {"least", "ms", 3}, {"most", "ms", 3}, {"wide", "%", 1}, {"run", "ms", 3}});
  for (const std::uint32_t pages : sizes_of(view)) {
    std::vector<Cell> row = {std::uint64_t{pages}};
    row.resize(table.columns().size());
    if (const TimeBand* const size = core::find_in(view.sizes, pages, &TimeBand::cache_pages)) {
      row[1] = static_cast<std::uint64_t>(std::llround(size->faults));
      row[4] = 100 * size->width();
      row[2] = milliseconds(size->least_ns);
      row[3] = milliseconds(size->most_ns);
    }
    if (pages == view.cache_pages) {
      row[5] = milliseconds(view.total_ns);
    }
    table.add_row(std::move(row));
  }
  table.add_note("Predicted from the run with " + counted(view.cache_pages, "page") + " alone. " + view.why);
  return table;
}

/// Returns the conclusion for a cache of twice as many pages or somewhat more.
std::string forecast_conclusion(const ForecastView& view) {
  const auto twice = std::find_if(view.sizes.begin(), view.sizes.end(),
                                  [&view](const TimeBand& size) { return size.cache_pages >= 2 * view.cache_pages; });
  if (twice == view.sizes.end()) {
    return "";
  }
  const std::string with = "With caches of " + counted(twice->cache_pages, "page") + " in place of " + grouped(view.cache_pages) +
                           " the run would " + (view.is_of_time ? "take " : "have ");
  const std::string unit = view.is_of_time ? "ns" : "";
  const std::string least = amount_text(twice->least_ns, unit), most = amount_text(twice->most_ns, unit);
  return with + (least == most ? most : least + " to " + most) + (view.is_of_time ? "" : " faults") +
         (twice->is_narrow() ? "." : ", which is vague: the ends lie " + share_text(twice->width()) + " apart.");
}

}  // namespace

std::optional<ForecastView> forecast_view(const RenderRecord& record) {
  const auto* const report = std::get_if<svm::Report>(&record.report);
  const Account account = account_of(record.report);
  if (report == nullptr || record.view == nullptr || !record.view->misses) {
    return std::nullopt;
  }
  const bool is_of_time = account.virtual_time.has_value();
  ForecastRun run{.cache_pages = report->plan.frames, .faults = report->pages().faults};
  if (is_of_time) {
    run.parts = parts_of(account);
    run.node_count = static_cast<std::uint32_t>(account.nodes.size());
  } else {  // as if a fault took a nanosecond, and nothing else took any time
    run.parts.ns[static_cast<std::size_t>(TimePart::data_wait)] = run.faults;
  }
  CacheForecast forecast = forecast_caches(run, *record.view->misses, static_cast<std::uint32_t>(record.database.page_count()));
  if (forecast.sizes.empty()) {
    return std::nullopt;
  }
  const std::string why = why_wide(forecast, is_of_time);
  return ForecastView{is_of_time, run.cache_pages, why, std::move(forecast.sizes), run.total_ns()};
}

json json_of(const ForecastView& view) {
  json points = json::array();
  for (const TimeBand& size : view.sizes) {
    points.push_back({size.cache_pages, std::llround(size.faults), std::llround(size.least_ns), std::llround(size.most_ns)});
  }
  return {{"unit", view.is_of_time ? "ns" : "faults"},
          {"cache", view.cache_pages},
          {"widest", TimeBand::width_max},
          {"why", view.why},
          {"points", std::move(points)},
          {"runs", json::array({{view.cache_pages, std::llround(view.total_ns)}})}};
}

void add_forecast(Page& page, const ForecastView& view) {
  page.add_conclusion(forecast_conclusion(view));
  page.add_place("what-if");
  if (view.is_of_time) {
    page.add_table(forecast_table(view));
  }
}

}  // namespace dmpc::apps::html

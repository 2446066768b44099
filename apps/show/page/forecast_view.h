// How long a run would take with other caches, as a page shows it: a table and a plot, and what its script draws.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/run/cache_forecast.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/show/page/web_part.h"
#include "apps/run/render_record.h"

namespace dmpc::apps::html {

extern const WebPart what_if_style;   ///< what_if.css
extern const WebPart what_if_script;  ///< for a page that plays no run: draws the band alone

/// A run that was made: its cache, and what it took.
struct MadeRun {
  std::uint32_t cache_pages = 0;
  double total_ns = 0;
};

/// A band beside runs.
struct ForecastView {
  std::uint32_t cache_pages = 0;  ///< the measured run's
  std::string why;                ///< the band is as wide as it is: sentences
  std::vector<TimeBand> sizes;    ///< in ascending order, whether narrow enough to be shown or not
  std::vector<MadeRun> runs;
};

/// Forecast from a finished run: nothing unless pages travel on a modelled machine and references were recorded, or if no
/// forecast can be made from them.
std::optional<ForecastView> forecast_view(const RenderRecord& record);

/// For scripts: {cache, widest (share), why, points: [[pages, faults, least_ns, most_ns]], runs: [[pages, ns]]}.
nlohmann::json json_of(const ForecastView& view);
/// What the page of a render says, read back; nothing if that has none. `file` is what messages call it. Throws core::InputError
/// for data that do not hold together.
std::optional<ForecastView> forecast_in(std::string_view page, const std::string& file);

/// Says it in a sentence and a table, and draws it: by gnuplot, and where scripts run by them, in a place of its own.
void add_forecast(Page& page, const ForecastView& view);
/// As above for a page that plays no run, with its scripts.
void add_forecast_alone(Page& page, const ForecastView& view);

}  // namespace dmpc::apps::html

// A page's forecast of a run's time with other cache sizes: a table and a plot, and the data that its script draws.
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

/// A run that was measured: its cache, and its time.
struct MadeRun {
  std::uint32_t cache_pages = 0;
  double total_ns = 0;
};

/// A band of predicted times beside measured runs; of threads, whose times say nothing about a machine, of predicted faults.
struct ForecastView {
  bool is_of_time = true;         ///< else all times are numbers of faults
  std::uint32_t cache_pages = 0;  ///< the measured run's
  std::string why;                ///< explains the band's width: sentences
  std::vector<TimeBand> sizes;    ///< in ascending order
  std::vector<MadeRun> runs;
};

/// Returns the forecast of a finished run; nothing unless pages travel and references were recorded, or if no forecast can be
/// made from them.
std::optional<ForecastView> forecast_view(const RenderRecord& record);

/// Returns the scripts' data: {unit ("ns" or "faults"), cache, widest (share of a band that is not vague), why, points: [[pages,
/// faults, least_ns, most_ns]], runs: [[pages, ns]]}.
nlohmann::json json_of(const ForecastView& view);
/// Reads the forecast of times back from the page of a render; nothing if it has none. `file` names the page in messages. Throws
/// core::InputError for inconsistent data.
std::optional<ForecastView> forecast_in(std::string_view page, const std::string& file);

/// Adds the forecast as a sentence, a table and an element in which a script draws it.
void add_forecast(Page& page, const ForecastView& view);
/// As above for a page that plays no run, with its scripts.
void add_forecast_alone(Page& page, const ForecastView& view);

}  // namespace dmpc::apps::html

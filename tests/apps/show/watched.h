// Small renders with all that looks on for a page, and for what else their options ask for.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "apps/render/observers.h"
#include "apps/run/run_strategy.h"
#include "tests/apps/show/rendered.h"

namespace dmpc::apps {

/// A render with --report, and what its observers have seen.
struct Watched {
  explicit Watched(RenderOptions given, std::size_t references_max = 1'000'000) : options(std::move(given)) {
    options.report = "page.html";
    Subject subject = build_subject(load_scene(options.picture), options.picture, options.database);
    database = std::move(subject.database);
    Observers observers(observer_order(options, static_cast<std::uint32_t>(database.page_count()),
                                       subject.settings.camera.pixel_count(), references_max));
    options.pages.reference_logs = observers.reference_logs();
    report = make_ready(options, database, subject.settings, {}, observers.watching()).start({}, {});
    run_profile = observers.take();
    if (observers.heat() != nullptr) {
      heat = *observers.heat();
    }
  }
  RenderRecord record() const {
    return {.options = options,
            .database = database,
            .report = *report,
            .seconds = {},
            .heat = heat ? &*heat : nullptr,
            .view = &*run_profile.view};
  }
  const RunView& view() const { return *run_profile.view; }

  RenderOptions options;
  core::Database database;
  std::optional<Report> report;
  RunProfile run_profile;
  std::optional<nodes::HeatMap> heat;  ///< what a page plays, and what options.heat_maps ask for
};

/// With caches so small that pages are fetched.
inline RenderOptions starved(RenderOptions options) {
  options.picture.scene = "balls-2";
  options.database.build.page_size_bytes = 512;
  options.pages.cache_pages = 4;
  return options;
}

}  // namespace dmpc::apps

// Compares two pages of renders: their counters, and a page with both runs on one clock.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/lab/compare/differences.h"
#include "apps/reader/confinement.h"
#include "apps/show/page/played_run.h"

namespace dmpc::apps {

struct PlayedPage {
  std::string file;  ///< as it was typed
  html::PlayedRun run;
};

/// Reads the run that a page plays. Throws core::InputError if it cannot be read, is not a render's page, or is inconsistent.
PlayedPage read_page(const std::filesystem::path& file);

/// Compares the counters stored in pages. If a page has none, returns nothing if `may_be_absent` and none are requested, else
/// throws core::InputError.
std::optional<FigureComparison> compare_counters_of(const std::array<PlayedPage, 2>& pages, const FigureChoice& choice,
                                                    bool may_be_absent);

/// Returns which of them has no counters, and what to do.
std::string without_counters(const std::array<PlayedPage, 2>& pages);

/// Returns the page. Throws core::InputError if a picture cannot be read within `sandbox`, or if their clocks differ.
std::string page_of(const std::array<PlayedPage, 2>& pages, const std::optional<FigureComparison>& counters, Sandbox sandbox);

}  // namespace dmpc::apps

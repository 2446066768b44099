// The page of two runs on one clock, of what their own pages have kept.
#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string>

#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/table/table.h"
#include "apps/picture/image_file.h"
#include "apps/show/page/played_run.h"

namespace dmpc::apps::html {

/// One of them.
struct ComparedPage {
  std::string file;  ///< as it was typed
  PlayedRun run;
  Image picture;
};

/// A and B, and what is known of both beside that.
struct Comparison {
  std::array<ComparedPage, 2> pages;
  std::string picture_sentence;        ///< how far the pictures lie apart; empty: nothing to say
  std::string counter_sentence;        ///< what became of their counters
  std::optional<Table> counters = {};  ///< counters that differ
};

/// The whole document. Plots that cannot be drawn are reported to `complaints`. Throws core::InputError if the runs' clocks
/// differ, of which one time would be said then, or if no temporary file can be written.
std::string comparison_page(const Comparison& comparison, const Origin& origin, std::ostream& complaints);

/// Milliseconds of a node's mean by what it did or waited for: a row each that either run has, and one for the whole run, to
/// which the others add up.
Table time_table(const std::array<ComparedPage, 2>& pages);

}  // namespace dmpc::apps::html

// The page that compares two runs on one clock, from the data in their own pages.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/table/table.h"
#include "apps/picture/image_file.h"
#include "apps/show/page/played_run.h"

namespace dmpc::apps::html {

struct ComparedPage {
  std::string file;  ///< as it was typed
  PlayedRun run;
  Image picture;
};

/// A and B, and what else is known of both.
struct Comparison {
  std::array<ComparedPage, 2> pages;
  std::string picture_sentence;        ///< difference of the pictures; empty: nothing to report
  std::string counter_sentence;        ///< comparison of their counters
  std::optional<Table> counters = {};  ///< counters that differ
};

/// Returns the whole document. Throws core::InputError if the runs' clocks differ, so that they have no common time, or if no
/// temporary file can be written.
std::string comparison_page(const Comparison& comparison, const Origin& origin);

/// Returns milliseconds of a node's mean by what it did or waited for: a row for each item that either run has, and one for the
/// whole run, to which the others add up.
Table time_table(const std::array<ComparedPage, 2>& pages);

}  // namespace dmpc::apps::html

// What commands have in common that measure for a while and leave a table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/show/page/page.h"
#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table_files.h"
#include "apps/show/page/forecast_view.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// What is a command's own. The functions are called once each, in this order.
struct TabledJob {
  std::function<void()> measure;
  std::function<bool()> has_findings = {};                             ///< though measure() threw; without it there are none then
  const char* consequence = "the table has the rows finished before";  ///< of a signal, once it is written: a literal
  /// Writes what was found, all of it or what there is.
  std::function<void(bool is_whole, Attempts& attempts)> write = {};
};

/// Measures, and writes what was found whatever ended that: a table to the file asked for (whole or not at all), else to the
/// standard output, then the page and the plots asked for. Progress goes to stderr if that is a terminal. What cannot be written
/// is said on stderr and keeps nothing else from being written. Returns the exit status, 0 or that of the first such output;
/// rethrows what ended the measuring before its time, Interrupted after a signal.
int run_tabled(const TabledJob& job, Interrupt& interrupt);
/// What is written is result(is_whole).
int run_tabled(TabledJob job, const std::function<TableResult(bool is_whole)>& result, const TableFiles& files,
               Interrupt& interrupt, std::ostream& output);

/// One table with its plots, and what its page tells beside them.
struct StudyFindings {
  std::string title;  ///< of the page
  Table table;
  std::string data_file;  ///< beside what is drawn of it
  std::vector<Plot> plots;
  std::string conclusion = {};  ///< a sentence; empty: none
  html::Facts facts = {};       ///< by which another study is known to have found the same
  std::optional<std::uint64_t> scene_digest = {};
  std::optional<html::ForecastView> forecast = {};  ///< from one of its runs, beside all of them
};
TableResult study_result(StudyFindings findings, TableFormat format);

/// Throws core::CapacityError if none of the results has `figures`, for the reason that is the first one's `misfit`.
template <class Results>
void check_any_fits(const Results& results) {
  if (std::none_of(results.begin(), results.end(), [](const auto& result) { return result.figures.has_value(); })) {
    throw core::CapacityError(results.front().misfit);
  }
}

}  // namespace dmpc::apps

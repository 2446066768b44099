// The common part of commands that measure for a while and produce a table.
#pragma once

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

namespace dmpc::apps {

/// The command's own part. The functions are called once each, in this order.
struct TabledJob {
  std::function<void()> measure;
  std::function<bool()> has_findings = {};  ///< whether there are findings although measure() threw; without this function there
                                            ///< are none
  const char* consequence = "the table has the rows finished before";  ///< of a signal, once the table is written: a literal
  /// Writes the findings, complete or not.
  std::function<void(bool is_whole, Attempts& attempts)> write = {};
};

/// Measures, and then writes the findings, whatever ended the measuring: the table atomically to the requested file, or else to
/// the standard output, then the requested page and plots. Progress goes to stderr if that is a terminal. A failed output is
/// reported on stderr and does not prevent others. Returns the exit status: 0, or that of the first failed output. Rethrows what
/// ended the measuring early, Interrupted after a signal.
int run_tabled(const TabledJob& job, Interrupt& interrupt);
/// As above; writes result(is_whole).
int run_tabled(TabledJob job, const std::function<TableResult(bool is_whole)>& result, const TableFiles& files,
               Interrupt& interrupt, std::ostream& output);

/// One table with its plots, and the other contents of its page.
struct StudyFindings {
  std::string title;  ///< of the page
  Table table;
  std::string data_file;  ///< name of the data file beside the plots
  std::vector<Plot> plots;
  std::string conclusion = {};  ///< a sentence; empty: none
  html::Facts facts = {};       ///< identify another study with the same findings
  std::optional<std::uint64_t> scene_digest = {};
};
TableResult study_result(StudyFindings findings, TableFormat format);

}  // namespace dmpc::apps

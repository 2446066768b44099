// The report of the study `paper`: its tables and their pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/output_set.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps {

struct NamedTable {
  std::string name;
  Table table;
};

struct PaperReport {
  std::vector<NamedTable> tables;
  std::vector<std::string> summary = {};  ///< paragraphs
  std::uint32_t resolution = 0;           ///< pixels a side of the pictures on which the tables are based
  bool is_complete = true;                ///< no row is missing
};

/// Returns the report in Markdown, without pictures.
std::string text_of(const PaperReport& report);

/// Returns the files that write_report() writes, whatever rows the tables have, as outputs of `option`.
std::vector<OutputName> report_files(const PaperReport& report, const std::filesystem::path& folder, const std::string& option);

/// Writes to a folder each table as CSV and JSON, a gnuplot script for each picture, the pictures that gnuplot makes of them, and
/// the text with links to the pictures as report.md, the page as index.html, the hashes of all these as SHA256SUMS, and all of it
/// as paper.zip. Returns sentences about pictures that could not be drawn, which report.md
/// has, too, and about missing hashes. Each file is one attempt.
std::vector<std::string> write_report(const PaperReport& report, const std::filesystem::path& folder, Attempts& attempts);

/// Returns the report as a page.
std::string page_of(const PaperReport& report);

struct PaperPlot {
  std::string table;  ///< name of the table's files: "table_3"
  Plot plot;
};

/// The article's values are drawn as points, ours as lines or bars.
std::vector<PaperPlot> paper_plots();

/// `name` is that of the table's files: "table_3". Returns an empty text for an unknown table.
std::string paper_conclusion(const std::string& name, const Table& table);

}  // namespace dmpc::apps

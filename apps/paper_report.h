// The report of the study `paper`: its tables, and the pictures of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/study_table.h"

namespace dmpc::apps {

/// A table with the name of its files.
struct NamedTable {
  std::string name;
  Table table;
};

struct PaperReport {
  std::string text;                     ///< in Markdown, with links to the pictures
  std::vector<std::string> complaints;  ///< sentences about pictures that could not be drawn; in the text, too
};

/// Pictures of `resolution` pixels a side. With a folder also writes there each table as CSV and JSON, a gnuplot script for each
/// picture, the pictures that gnuplot makes of them, and the text as report.md. Throws core::InputError for what cannot be
/// written.
PaperReport write_report(const std::vector<NamedTable>& tables, std::uint32_t resolution, bool is_complete,
                         const std::optional<std::filesystem::path>& folder);

}  // namespace dmpc::apps

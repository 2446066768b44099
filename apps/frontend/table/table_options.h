// Options of a command for its table, its page and its plots.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps {

struct TableOutput {
  TableFormat format = TableFormat::markdown;
  std::optional<std::filesystem::path> file;    ///< stdout if not given
  std::optional<std::filesystem::path> report;  ///< a page with the table and its pictures
  std::optional<std::filesystem::path> plots;   ///< a folder for plots and their data
};

enum class TableExtras : std::uint8_t { none, plots, plots_and_report };

/// Declares --format and -o, and --plots and --report if the command has them.
void add_options(OptionSet options, TableOutput& output, TableExtras extras);

/// Declares --report; its help ends with `what`, such as "the table and its plots". A name that does not end in .html is a
/// core::UsageError.
void add_report_option(OptionSet options, std::optional<std::filesystem::path>& report, const std::string& what);

}  // namespace dmpc::apps

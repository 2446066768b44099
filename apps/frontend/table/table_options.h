// How a command's table is asked for, and the page and pictures of it.
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
  std::optional<std::filesystem::path> plots;   ///< a folder for pictures by gnuplot and what they are drawn from
};

/// What a command has beside its table.
enum class TableExtras : std::uint8_t { none, plots, plots_and_report };

/// Declares --format and -o, and --plots and --report as far as the command has them.
void add_options(OptionSet options, TableOutput& output, TableExtras extras);

/// Declares --report; its help ends with `what`, such as "the table and its plots". A name that does not end in .html is an
/// core::UsageError.
void add_report_option(OptionSet options, std::optional<std::filesystem::path>& report, const std::string& what);

}  // namespace dmpc::apps

// How a command's table is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/command_line.h"
#include "apps/study_table.h"

namespace dmpc::apps {

/// Declares --format.
void add_format_option(OptionSet options, TableFormat& format);

/// Declares --report; its help ends with `what`, such as "the table and its plots". A name that does not end in .html is an
/// core::UsageError.
void add_report_option(OptionSet options, std::optional<std::filesystem::path>& report, const std::string& what);

}  // namespace dmpc::apps

// Pictures of tables, with what they are drawn from.
#pragma once

#include <filesystem>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "apps/plot.h"
#include "apps/study_table.h"

namespace dmpc::apps {

/// Writes to one folder, and complains to `complaints`, which outlives it, of pictures that are not drawn, each complaint once: a
/// picture is an extra.
class PlotFolder {
 public:
  PlotFolder(std::filesystem::path folder, std::ostream& complaints) : folder_(std::move(folder)), complaints_(complaints) {}

  /// Writes the table as CSV to `data_file`, and draws the plots of it. Throws core::InputError if a file cannot be written.
  void add(const Table& table, const std::string& data_file, std::span<const Plot> plots);

 private:
  std::filesystem::path folder_;
  std::ostream& complaints_;
  std::set<std::string> told_;
};

}  // namespace dmpc::apps

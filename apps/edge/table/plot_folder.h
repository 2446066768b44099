// Pictures of tables, with what they are drawn from.
#pragma once

#include <filesystem>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "apps/edge/system/attempts.h"
#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"

namespace dmpc::apps {

/// Writes to one folder, and complains to `complaints`, which outlives it, of pictures that are not drawn, each complaint once: a
/// picture is an extra.
class PlotFolder {
 public:
  PlotFolder(std::filesystem::path folder, std::ostream& complaints) : folder_(std::move(folder)), complaints_(complaints) {}

  /// Writes the table as CSV to `data_file`, and draws the plots of it if that is there: each file is one of the
  /// attempts.
  void add(const Table& table, const std::string& data_file, std::span<const Plot> plots, Attempts& attempts);

 private:
  void draw_one(const Plot& plot, const Table& table, const std::string& data_file);

  std::filesystem::path folder_;
  std::ostream& complaints_;
  std::set<std::string> told_;
};

}  // namespace dmpc::apps

// What a command leaves that prints a table: the table, a page with it, and pictures of it in a folder. Tried before the command
// begins, and written one by one, the table first.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/output_set.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/frontend/table/table_options.h"

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
  std::set<std::string> reported_;
};

/// What will lie in the folder of pictures: a table as CSV, and what is drawn from it.
struct PlottedNames {
  std::string data_file;
  std::vector<std::string> plots;  ///< without an extension
};
PlottedNames names_of(const std::string& data_file, const std::vector<Plot>& plots);

/// A table with its pictures.
struct PlottedTable {
  Table table;
  std::string data_file;
  std::vector<Plot> plots;
};

/// What there is to write in the end. The functions are called only if what they make is asked for.
struct TableResult {
  std::string text;  ///< the table in the format asked for, perhaps several
  std::function<std::string()> page = {};
  std::function<std::vector<PlottedTable>()> plotted = {};
};

/// Files of a command that are none of its table's.
struct OtherFiles {
  std::vector<NamedFile> inputs = {};
  std::vector<NamedFile> outputs = {};
};

/// Not thread-safe.
class TableFiles {
 public:
  /// Makes the folder of pictures. Throws core::UsageError if an output falls on an input or on another output, core::InputError
  /// if one cannot be made, as far as can be known beforehand, the standard output included.
  TableFiles(const TableOutput& asked, const std::vector<PlottedNames>& plotted, const OtherFiles& others = {});

  /// All outputs, the others included: none of them may be a file that a scene is read from.
  const std::vector<NamedFile>& names() const { return names_; }

  /// Writes the table to its file (whole or not at all) or to `output`, then the page, then the pictures; what fails keeps none
  /// that follows from being written. What could not be drawn is told to `complaints`: a picture is an extra.
  void write(const TableResult& result, std::ostream& output, std::ostream& complaints, Attempts& attempts) const;

 private:
  void write_plots(const TableResult& result, std::ostream& complaints, Attempts& attempts) const;

  TableOutput asked_;
  OutputSet<TableResult> files_;
  std::vector<NamedFile> names_;
};

}  // namespace dmpc::apps

// The outputs of a command that prints a table: the table, a page with it, and plots in a folder. They are checked before the
// command begins, and written one by one, the table first.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <ostream>
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

/// Writes plots to one folder.
class PlotFolder {
 public:
  explicit PlotFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the table as CSV to `data_file`, and what its plots draw. Each file is one attempt. Of a plot of no row older files
  /// go.
  void add(const Table& table, const std::string& data_file, std::span<const Plot> plots, Attempts& attempts);
  /// Draws all plots. They are optional: one sentence on `complaints` says why they are not drawn.
  void draw(std::ostream& complaints) const;

 private:
  void write_data(const Plot& plot, const Table& table);

  std::filesystem::path folder_;
  std::vector<std::string> names_;  ///< of plots with data
};

/// A table's files in the folder of plots: the CSV file and the plots.
struct PlottedNames {
  std::string data_file;
  std::vector<std::string> plots;  ///< without an extension
};
PlottedNames names_of(const std::string& data_file, const std::vector<Plot>& plots);

struct PlottedTable {
  Table table;
  std::string data_file;
  std::vector<Plot> plots;
};

/// The results to write. The functions are called only if their output is requested.
struct TableResult {
  std::string text;  ///< the table in the requested format; may be several tables
  std::function<std::string()> page = {};
  std::function<std::vector<PlottedTable>()> plotted = {};
};

struct OtherFiles {
  std::vector<NamedFile> inputs = {};
  std::vector<NamedFile> outputs = {};
};

/// Not thread-safe.
class TableFiles {
 public:
  /// Makes the folder of plots. Throws core::UsageError if an output is the same file as an input or another output, and
  /// core::InputError if an output cannot be made, as far as can be known in advance, including the standard output.
  TableFiles(const TableOutput& asked, const std::vector<PlottedNames>& plotted, const OtherFiles& others = {});

  /// All outputs, including other files: none of them may be a file that a scene is read from.
  const std::vector<NamedFile>& names() const { return names_; }

  /// Writes the table to its file (atomically) or to `output`, then the page, then the plots; a failure does not prevent later
  /// ones. Plots are optional, so those that cannot be drawn are reported to `complaints`.
  void write(const TableResult& result, std::ostream& output, std::ostream& complaints, Attempts& attempts) const;

 private:
  void write_plots(const TableResult& result, std::ostream& complaints, Attempts& attempts) const;

  TableOutput asked_;
  OutputSet<TableResult> files_;
  std::vector<NamedFile> names_;
};

}  // namespace dmpc::apps

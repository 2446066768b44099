#include "apps/frontend/table/table_files.h"

#include <optional>
#include <system_error>

#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/table/plot_data.h"
#include "apps/frontend/table/plot_program.h"

namespace dmpc::apps {
namespace {

constexpr const char* data_ending = ".json";
constexpr const char* picture_ending = ".svg";

void add_plots(const std::filesystem::path& folder, const std::vector<PlottedNames>& plotted, OutputSet<TableResult>& files) {
  const auto add = [&](const std::string& name) { files.add("--plots", folder / name, check_output_path, nullptr); };
  for (const PlottedNames& names : plotted) {
    add(names.data_file);
    for (const std::string& plot : names.plots) {
      add(plot + data_ending);
      add(plot + picture_ending);
    }
  }
}

OutputSet<TableResult> files_of(const TableOutput& asked, const std::vector<PlottedNames>& plotted) {
  OutputSet<TableResult> files;
  if (asked.file) {
    files.add("-o", *asked.file, check_output_path, [](const TableResult& result, std::ostream& file) { file << result.text; });
  }
  if (asked.report) {
    files.add("--report", *asked.report, check_output_path,
              [](const TableResult& result, std::ostream& file) { file << result.page(); });
  }
  if (asked.plots) {
    add_plots(*asked.plots, plotted, files);
  }
  return files;
}

}  // namespace

void PlotFolder::add(const Table& table, const std::string& data_file, std::span<const Plot> plots, Attempts& attempts) {
  const bool has_data = attempts.make([&] { write_file(folder_ / data_file, text_of(table, TableFormat::csv)); });
  if (has_data) {
    for (const Plot& plot : plots) {
      attempts.make([&] { write_data(plot, table); });
    }
  }
}

void PlotFolder::write_data(const Plot& plot, const Table& table) {
  const auto path = [&](const char* ending) { return folder_ / (plot.name + ending); };
  std::error_code ignored;
  std::filesystem::remove(path(picture_ending), ignored);
  if (const std::optional<std::string> data = plot_data(plot, table)) {
    write_file(path(data_ending), *data);
    names_.push_back(plot.name);
  } else {
    std::filesystem::remove(path(data_ending), ignored);
  }
}

void PlotFolder::draw(std::ostream& complaints) const {
  if (const std::string complaint = names_.empty() ? "" : draw_plots(folder_, names_); !complaint.empty()) {
    complaints << "dmpc: " << complaint << std::endl;
  }
}

PlottedNames names_of(const std::string& data_file, const std::vector<Plot>& plots) {
  PlottedNames names{data_file, {}};
  for (const Plot& plot : plots) {
    names.plots.push_back(plot.name);
  }
  return names;
}

/// The folder is made first: only then is it known whether an output lies in it.
TableFiles::TableFiles(const TableOutput& asked, const std::vector<PlottedNames>& plotted, const OtherFiles& others)
    : asked_(asked), files_(files_of(asked, plotted)) {
  if (asked.plots) {
    make_output_folder(*asked.plots, "--plots");
  }
  std::vector<OutputName> outputs = files_.names();
  for (const NamedFile& other : others.outputs) {
    outputs.push_back({other, check_output_path});
  }
  check_outputs(others.inputs, outputs);
  if (asked.report) {
    const ScratchFolder probe;
  }
  if (!asked.file) {
    check_standard_output("the table", "-o FILE writes it to a file");
  }
  check_open_files();
  names_ = dmpc::apps::files_of(outputs);
}

void TableFiles::write(const TableResult& result, std::ostream& output, std::ostream& complaints, Attempts& attempts) const {
  if (!asked_.file) {
    attempts.make([&] {
      output << result.text;
      finish_output(output, "the table");
    });
  }
  files_.write(result, attempts);
  if (asked_.plots) {
    write_plots(result, complaints, attempts);
  }
}

void TableFiles::write_plots(const TableResult& result, std::ostream& complaints, Attempts& attempts) const {
  PlotFolder folder(*asked_.plots);
  std::vector<PlottedTable> plotted;
  attempts.make([&] { plotted = result.plotted(); });
  for (const PlottedTable& one : plotted) {
    folder.add(one.table, one.data_file, one.plots, attempts);
  }
  folder.draw(complaints);
}

}  // namespace dmpc::apps

#include "apps/frontend/table/table_options.h"

#include "core/base/expect.h"

namespace dmpc::apps {

void add_options(OptionSet options, TableOutput& output, TableExtras extras) {
  options.add_choice<TableFormat>("--format", output.format,
                                  {{"markdown", TableFormat::markdown},
                                   {"csv", TableFormat::csv},
                                   {"json", TableFormat::json},
                                   {"jsonl", TableFormat::json_lines}},
                                  "Format of the table");
  if (extras == TableExtras::plots_and_report) {
    add_report_option(options, output.report, "with the table and its plots");
  }
  if (extras != TableExtras::none) {
    options.add_path("--plots", "FOLDER", output.plots, "Write plots by Python's matplotlib to this folder, with their data");
  }
  options.add_path("-o,--output", "FILE [stdout]", output.file, "Output file");
}

void add_report_option(OptionSet options, std::optional<std::filesystem::path>& report, const std::string& what) {
  options.add_path("--report", "FILE.html", report, "Write a page for a browser, " + what);
  options.check_in_the_end([&report] {
    if (report && report->extension() != ".html") {
      throw core::UsageError("--report=" + report->string() + ": expected a file with the ending .html");
    }
  });
}

}  // namespace dmpc::apps

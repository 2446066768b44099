#include "apps/table_options.h"

#include "core/expect.h"

namespace dmpc::apps {

void add_format_option(OptionSet options, TableFormat& format) {
  options.add_choice<TableFormat>("--format", format,
                                  {{"markdown", TableFormat::markdown}, {"csv", TableFormat::csv}, {"json", TableFormat::json}},
                                  "How the table is written");
}

void add_report_option(OptionSet options, std::optional<std::filesystem::path>& report, const std::string& what) {
  options.add_path("--report", "FILE.html", report, "Write a page to be read in a browser, " + what);
  options.check_in_the_end([&report] {
    if (report && report->extension() != ".html") {
      throw core::UsageError("--report=" + report->string() + ": expected a file with the ending .html");
    }
  });
}

}  // namespace dmpc::apps

#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/python/python_study.h"

namespace dmpc::apps {
namespace {

void declare_paper(OptionSet set, PythonStudy& study) {
  set.add_number("--resolution", study.side, 8, 4096, "512, the article's", "Pixels a side of every picture");
  set.add_flag("--sensitivity", study.is_set,
               "Also change each figure of the machine by a fifth, and show what it does: some minutes more");
  set.add_text(
      "-o,--output", "FOLDER", passed_on,
      "Where the report goes, as a page and as Markdown, with each table as CSV and JSON, plots by Python's matplotlib, hashes, "
      "and all of it as paper.zip; and the counters of all runs");
  add_report_option(set, study.report, "with the tables and their plots");
  add_run_options(set, study);
  set.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: ten minutes of processor time\n"
      "  dmpc study paper --sensitivity -o paper\n"
      "  dmpc study paper --resolution=64       to see what it prints, not what is true");
}

}  // namespace

PythonStudy paper_study() { return {.name = "paper", .module = "paper.command", .declare = declare_paper}; }

}  // namespace dmpc::apps

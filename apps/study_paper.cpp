#include "apps/study_paper.h"

#include <algorithm>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "apps/output_file.h"
#include "apps/paper_calibration.h"
#include "apps/paper_catalogue.h"
#include "apps/paper_claims.h"
#include "apps/paper_law.h"
#include "apps/paper_memories.h"
#include "apps/paper_report.h"
#include "apps/paper_runs.h"
#include "apps/paper_sensitivity.h"
#include "apps/paper_tables.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

Table claims_with_note(const Catalogue& catalogue, const PaperResults& results, bool has_all) {
  Table table = claims(catalogue, results);
  if (!has_all) {
    table.add_note("Interrupted: claims are missing, and others may rest on fewer runs.");
  }
  return table;
}

bool has_first(const PaperResults& results, std::size_t count) {
  return std::all_of(results.begin(), results.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const auto& result) { return result.has_value(); });
}

/// All but the sensitivity, which rest on the first runs.
std::vector<NamedTable> tables_of(const Catalogue& catalogue, const PaperResults& results,
                                  const std::vector<PaperSubject>& subjects, std::size_t run_count) {
  return {{"table_2", table_2(catalogue, results, subjects)},
          {"table_3", table_3(catalogue, results)},
          {"calibration", calibration(catalogue, results)},
          {"law", beside_law(catalogue, results)},
          {"against_law", against_law(catalogue, results)},
          {"memories", memories(catalogue, results)},
          {"losses", losses(catalogue, results)},
          {"algorithms", algorithms(catalogue, results)},
          {"caches", caches(catalogue, results)},
          {"claims", claims_with_note(catalogue, results, has_first(results, run_count))}};
}

}  // namespace

void add_options(OptionSet options, PaperStudyOptions& paper) {
  options.add_number("--resolution", paper.resolution, 8, 4096, "512, the article's", "Pixels a side of every picture");
  options.add_flag("--sensitivity", paper.has_sensitivity,
                   "Also change each figure of the machine by a fifth, and show what it does: some minutes more");
  options.add_path("-o,--output", "FOLDER", paper.output,
                   "Where report.md goes, with each table as CSV and JSON and pictures by gnuplot");
  options.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: some minutes\n"
      "  dmpc study paper --sensitivity -o paper\n"
      "  dmpc study paper --resolution=64       a quick look");
}

int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  if (options.output) {
    make_output_folder(*options.output, "-o");
  }
  Catalogue catalogue = catalogue_of(options.resolution);
  const std::size_t run_count = catalogue.runs.size();  // without the sensitivity's
  const std::vector<VariedRuns> varied = options.has_sensitivity ? add_variations(catalogue) : std::vector<VariedRuns>();
  const std::vector<PaperSubject> subjects = [&] {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    return paper_subjects(catalogue.runs);
  }();
  const PaperResults results = carry_out(catalogue.runs, subjects, interrupt);
  const bool is_complete = has_first(results, results.size());
  interrupt.set_consequence(is_complete ? "the report is complete" : "the report has the rows finished before");
  std::vector<NamedTable> tables = tables_of(catalogue, results, subjects, run_count);
  if (options.has_sensitivity) {
    tables.push_back({"sensitivity", sensitivity(catalogue, results, varied)});
  }
  const PaperReport report = write_report(tables, options.resolution, is_complete, options.output);
  for (const std::string& complaint : report.complaints) {
    std::cerr << "dmpc: " << complaint << std::endl;
  }
  output << report.text;
  finish_output(output, "the report");
  interrupt.check();
  return 0;
}

}  // namespace dmpc::apps

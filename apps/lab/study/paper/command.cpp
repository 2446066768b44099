#include "apps/lab/study/paper/command.h"

#include <algorithm>
#include <iostream>
#include <string>

#include "apps/frontend/system/attempts.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/output_set.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/lab/study/paper/calibration.h"
#include "apps/lab/study/paper/law.h"
#include "apps/lab/study/paper/report.h"
#include "apps/lab/study/paper/runs.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

bool has_first(const PaperResults& results, std::size_t count) {
  return std::all_of(results.begin(), results.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const auto& result) { return result.has_value(); });
}

Table claims_with_note(const Catalogue& catalogue, const PaperResults& results) {
  Table table = claims(catalogue, results);
  if (!has_first(results, catalogue.run_count_without_variations)) {
    table.add_note("Unfinished: claims are missing, and others may rest on fewer runs.");
  }
  return table;
}

/// Returns all tables except the sensitivity: the article's structure first, dmpc's grid behind.
std::vector<NamedTable> tables_of(const Catalogue& catalogue, const PaperResults& results,
                                  const std::vector<PaperSubject>& subjects) {
  return {{"summary", summary_table(catalogue, results)},     {"claims", claims_with_note(catalogue, results)},
          {"table_2", table_2(catalogue, results, subjects)}, {"table_3", table_3(catalogue, results)},
          {"algorithms", algorithms(catalogue, results)},     {"caches", caches(catalogue, results)},
          {"region_loads", region_loads(catalogue, results)}, {"ray_ways", ray_ways(catalogue, results)},
          {"work_items", work_items(catalogue, results)},     {"losses", losses(catalogue, results)},
          {"voxel_prices", voxel_prices(catalogue, results)}, {"voxel_pairs", voxel_pairs(catalogue, results)},
          {"law", against_model(catalogue, results)},         {"grid_table_3", grid_table_3(catalogue, results)},
          {"calibration", calibration(catalogue, results)}};
}

PaperReport report_of(const Catalogue& catalogue, const std::vector<VariedRuns>& varied, const PaperResults& results,
                      const std::vector<PaperSubject>& subjects) {
  PaperReport report{.tables = tables_of(catalogue, results, subjects),
                     .summary = summary_texts(catalogue, results),
                     .resolution = catalogue.resolution,
                     .is_complete = has_first(results, results.size())};
  if (!varied.empty()) {
    report.tables.push_back({"sensitivity", sensitivity(catalogue, results, varied)});
  }
  return report;
}

/// Throws core::UsageError or core::InputError unless all outputs can be made, as far as can be known beforehand.
void check_files(const PaperStudyOptions& options, const PaperReport& empty) {
  std::vector<OutputName> outputs;
  if (options.output) {
    make_output_folder(*options.output, "-o");
    outputs = report_files(empty, *options.output, "-o");
  }
  if (options.report) {
    outputs.push_back({{"--report", *options.report}});
    const ScratchFolder probe;
  }
  check_outputs({}, outputs);
  check_standard_output("the report", "redirect it elsewhere");
  check_open_files();
}

/// Writes the known results: to `output` before the folder, so that a failure there loses nothing.
void publish(const PaperReport& report, const PaperStudyOptions& options, std::ostream& output, Attempts& attempts) {
  attempts.make([&] {
    output << text_of(report);
    finish_output(output, "the report");
  });
  if (options.output) {
    for (const std::string& complaint : write_report(report, *options.output, attempts)) {
      std::cerr << "dmpc: " << complaint << std::endl;
    }
  }
  if (options.report) {
    attempts.make([&] { write_file(*options.report, page_of(report)); });
  }
}

/// Shows rows of tables whose rows need a run or two, as they finish.
void show_rows(const Catalogue& catalogue, const PaperResults& results, ShownRows& shown) {
  constexpr std::size_t key_count = 2;  // a scene, and nodes or a size
  if (shown.is_shown()) {
    shown.show(table_3(catalogue, results), key_count);
    shown.show(algorithms(catalogue, results), key_count);
    shown.show(ray_ways(catalogue, results), key_count);
    shown.show(work_items(catalogue, results), key_count);
    shown.show(caches(catalogue, results), key_count);
  }
}

}  // namespace

void add_options(OptionSet options, PaperStudyOptions& paper) {
  options.add_number("--resolution", paper.resolution, 8, 4096, "512, the article's", "Pixels a side of every picture");
  options.add_flag("--sensitivity", paper.has_sensitivity,
                   "Also change each figure of the machine by a fifth, and show what it does: some minutes more");
  options.add_path(
      "-o,--output", "FOLDER", paper.output,
      "Where the report goes, as a page and as Markdown, with each table as CSV and JSON, pictures by gnuplot, hashes, "
      "and all of it as paper.zip");
  add_report_option(options, paper.report, "with the tables and their plots");
  options.add_quiet(paper.quiet);
  options.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: ten minutes of processor time\n"
      "  dmpc study paper --sensitivity -o paper\n"
      "  dmpc study paper --resolution=64       to see what it prints, not what is true");
}

int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  Catalogue catalogue = catalogue_of(options.resolution);
  const std::vector<VariedRuns> varied = options.has_sensitivity ? add_variations(catalogue) : std::vector<VariedRuns>();
  check_files(options, report_of(catalogue, varied, PaperResults(catalogue.runs.size()), {}));
  return study_catalogue(catalogue, varied, options, interrupt, output);
}

int study_catalogue(const Catalogue& catalogue, const std::vector<VariedRuns>& varied, const PaperStudyOptions& options,
                    Interrupt& interrupt, std::ostream& output) {
  const std::vector<PaperSubject> subjects = [&] {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    return paper_subjects(catalogue.runs);
  }();
  PaperResults results(catalogue.runs.size());
  ShownRows shown(shows_rows({}, options.quiet), std::cerr);
  const auto write = [&](bool, Attempts& attempts) {
    const PaperReport report = report_of(catalogue, varied, results, subjects);
    if (report.is_complete) {
      interrupt.set_consequence("the report is complete");
    }
    publish(report, options, output, attempts);
  };
  const auto measure = [&] {
    carry_out(catalogue.runs, subjects, interrupt, results, [&] { show_rows(catalogue, results, shown); });
  };
  const int status = run_tabled({.measure = measure,
                                 .has_findings = [] { return true; },
                                 .consequence = "the report has the rows finished before",
                                 .write = write},
                                interrupt);
  interrupt.check();
  return status;
}

}  // namespace dmpc::apps

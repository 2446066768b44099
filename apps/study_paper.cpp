#include "apps/study_paper.h"

#include <ostream>
#include <string>
#include <vector>

#include "apps/output_file.h"
#include "apps/paper_catalogue.h"
#include "apps/paper_claims.h"
#include "apps/paper_runs.h"
#include "apps/paper_tables.h"
#include "apps/study_table.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

struct NamedTable {
  const char* name;
  Table table;
};

std::string report_text(const std::vector<NamedTable>& tables, const PaperStudyOptions& options, bool is_complete) {
  std::string text =
      "# The tables of 1994, regenerated\n\nD. Badouel, K. Bouatouch, T. Priol, \"Distributing Data and Control for "
      "Ray Tracing in Parallel\", on the modelled iPSC/2 (`dmpc machine ipsc2`), pictures of " +
      std::to_string(options.resolution) + "x" + std::to_string(options.resolution) + " pixels.\n";
  text += is_complete ? "" : "\nInterrupted: rows are missing.\n";
  for (const NamedTable& named : tables) {
    text += "\n" + text_of(named.table, TableFormat::markdown);
  }
  return text;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_folder(const std::filesystem::path& folder, const std::vector<NamedTable>& tables, const std::string& report) {
  for (const NamedTable& named : tables) {
    write_file(folder / (std::string(named.name) + ".csv"), text_of(named.table, TableFormat::csv));
    write_file(folder / (std::string(named.name) + ".json"), text_of(named.table, TableFormat::json));
  }
  write_file(folder / "report.md", report);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw core::InputError("-o " + folder.string() + ": expected a folder, or a name for one that can be made");
  }
  check_output_path(folder / "report.md", "-o");
}

}  // namespace

void add_options(OptionSet options, PaperStudyOptions& paper) {
  options.add_number("--resolution", paper.resolution, 8, 4096, "512, the article's", "Pixels a side of every picture");
  options.add_path("-o,--output", "FOLDER", paper.output, "Where report.md goes, with each table as CSV and JSON");
  options.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: some minutes\n"
      "  dmpc study paper --resolution=64       a quick look");
}

int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  if (options.output) {
    make_folder(*options.output);
  }
  const Catalogue catalogue = catalogue_of(options.resolution);
  const std::vector<PaperSubject> subjects = [&] {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    return paper_subjects(catalogue.runs);
  }();
  const PaperResults results = carry_out(catalogue.runs, subjects, interrupt);
  const std::vector<NamedTable> tables = {{"table_2", table_2(catalogue, results, subjects)},
                                          {"table_3", table_3(catalogue, results)},
                                          {"calibration", calibration(catalogue, results)},
                                          {"losses", losses(catalogue, results)},
                                          {"algorithms", algorithms(catalogue, results)},
                                          {"caches", caches(catalogue, results, subjects)},
                                          {"claims", claims(catalogue, results)}};
  const std::string report = report_text(tables, options, !interrupt.requested());
  output << report;
  if (options.output) {
    write_folder(*options.output, tables, report);
  }
  finish_output(output, "the report");
  interrupt.set_consequence("the report has the rows finished before");
  interrupt.check();
  return 0;
}

}  // namespace dmpc::apps

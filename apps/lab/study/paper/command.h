// The study `paper`: the tables and claims of the 1994 article, regenerated on its machine and compared with the printed ones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/sensitivity.h"

namespace dmpc::apps {

struct PaperStudyOptions {
  /// Pixels a side of every picture. With a resolution other than the article's nothing is judged.
  std::uint32_t resolution = paper_resolution;
  bool has_sensitivity = false;                 ///< also vary each figure of the machine and show the effect
  std::optional<std::filesystem::path> output;  ///< a folder for the report, its tables and plots; if not given, only the report
                                                ///< is printed
  std::optional<std::filesystem::path> report;  ///< a page with the tables and their pictures
  bool quiet = false;                           ///< no progress
};

void add_options(OptionSet options, PaperStudyOptions& paper);

/// Renders some hundred pictures in virtual time, and two hundred and fifty more for the sensitivity. Returns the exit status.
/// Throws core::InputError for a folder that cannot be written, and what study_catalogue() throws.
int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output);

/// Carries out the catalogue's runs, as many at a time as there are cores, and writes the report as Markdown to `output`; then,
/// with options.output, the report with its pictures and each table as CSV and JSON to that existing folder, and with
/// options.report a page. Without varied runs there is no table of the sensitivity. Progress goes to stderr if that is a
/// terminal; a sentence on pictures that could not be drawn always goes there. After a signal or an exception of a run, all
/// outputs have the known rows and say how many are missing; then it throws Interrupted, or rethrows. A failed output is reported
/// on stderr, does not prevent others, and sets the returned exit status. Throws core::InternalError if two runs of a scene give
/// different films.
int study_catalogue(const Catalogue& catalogue, const std::vector<VariedRuns>& varied, const PaperStudyOptions& options,
                    Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

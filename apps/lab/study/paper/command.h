// The study `paper`: the tables and claims of the 1994 article, regenerated on its machine and held against what it prints.
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
  /// Pixels a side of every picture. With others than the article's nothing is judged.
  std::uint32_t resolution = paper_resolution;
  bool has_sensitivity = false;                 ///< also change each figure of the machine and see what that does
  std::optional<std::filesystem::path> output;  ///< a folder for the report, its tables and plots; without it the report alone
  std::optional<std::filesystem::path> report;  ///< a page with the tables and their pictures
  bool quiet = false;                           ///< no progress
};

/// Declares them.
void add_options(OptionSet options, PaperStudyOptions& paper);

/// Renders some hundred pictures in virtual time, with the sensitivity two hundred and fifty more. Returns the exit status.
/// Throws core::InputError for a folder that cannot be written, and what study_catalogue() throws.
int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output);

/// Carries out the catalogue's runs, as many at once as there are cores, and writes the report as Markdown to `output`; then,
/// with options.output, the report with its pictures and each table as CSV and JSON to that folder, which exists, and with
/// options.report a page. Without varied
/// runs there is no table of the sensitivity. Progress goes to stderr if that is a terminal; a sentence on pictures that could
/// not be drawn goes there always. After a signal, or whatever a run throws, all of this has the rows that are known and says how
/// many are missing; then throws Interrupted, or rethrows. What cannot be written is said on stderr and costs nothing else:
/// the exit status, which is returned, tells. Throws core::InternalError if two runs of a scene give different films.
int study_catalogue(const Catalogue& catalogue, const std::vector<VariedRuns>& varied, const PaperStudyOptions& options,
                    Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

// The study `paper`: the tables and claims of the 1994 article, regenerated on its machine and held against what it prints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "apps/command_line.h"
#include "apps/interrupt.h"

namespace dmpc::apps {

struct PaperStudyOptions {
  /// Pixels a side of every picture. The article's is 512; smaller ones are quicker and prove nothing.
  std::uint32_t resolution = 512;
  bool has_sensitivity = false;                 ///< also change each figure of the machine and see what that does
  std::optional<std::filesystem::path> output;  ///< a folder for the report, its tables and plots; without it the report alone
};

/// Declares them.
void add_options(OptionSet options, PaperStudyOptions& paper);

/// Renders some seventy pictures in virtual time, with the sensitivity three hundred more, as many at once as there are cores,
/// and writes the report as Markdown to `output`; with options.output also each table as CSV and JSON and its pictures there.
/// Progress goes to stderr if that is a terminal, and so does a sentence on pictures that could not be drawn. Returns 0. After a
/// signal the tables have the rows that are known and say how many are missing; then throws Interrupted. Throws core::InputError
/// for a folder that cannot be written, core::InternalError if two runs of a scene give different films.
int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

// gnuplot, as a process of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps {

/// What became of a picture.
struct PlotOutcome {
  bool is_drawn = false;
  bool is_program_missing = false;
  std::string complaint;  ///< if it is not drawn: a sentence, with what the program said
};

/// What to tell about a picture that is not drawn: a sentence without its full stop, the same for all if the program is missing.
std::string sentence_on(const PlotOutcome& outcome);

/// Writes NAME.gnuplot into `folder`, where `data_file` is the table as CSV, and lets `program` make NAME.svg of it there;
/// nothing if there is nothing to draw. An older NAME.svg goes first, and so does one that was not finished. `program` is looked
/// for along PATH unless it has a slash; waits for its end. What goes wrong with it is told by the outcome alone, for a picture
/// is an extra; throws core::InputError if the script cannot be written. Signals that are blocked here are not blocked there.
/// Thread-safe for different names.
std::optional<PlotOutcome> draw(const Plot& plot, const Table& table, const std::filesystem::path& folder,
                                const std::string& data_file, const std::string& program = "gnuplot");

}  // namespace dmpc::apps

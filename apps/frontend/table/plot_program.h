// Runs gnuplot as a separate process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps {

struct PlotOutcome {
  bool is_drawn = false;
  bool is_program_missing = false;
  std::string complaint;  ///< if it is not drawn: a sentence with the program's message
};

/// Returns the message about a picture that is not drawn: a sentence without its full stop, the same for all if the program is
/// missing.
std::string sentence_on(const PlotOutcome& outcome);

/// Writes NAME.gnuplot into `folder`, where `data_file` is the table as CSV, and has `program` make NAME.svg of it there; returns
/// nothing if there is nothing to draw. An older or unfinished NAME.svg is removed. `program` is searched along PATH unless it
/// has a slash; draw() waits for its end. The outcome alone reports its errors, as a picture is optional; throws core::InputError
/// if the script cannot be written. The program does not inherit blocked signals. Thread-safe for different names.
std::optional<PlotOutcome> draw(const Plot& plot, const Table& table, const std::filesystem::path& folder,
                                const std::string& data_file, const std::string& program = "gnuplot");

}  // namespace dmpc::apps

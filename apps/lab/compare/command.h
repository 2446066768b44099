// The command `compare`: the difference of two pictures, the counters that differ between two runs, or both runs on one clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/lab/compare/differences.h"
#include "apps/lab/compare/limit.h"
#include "apps/reader/confinement.h"

namespace dmpc::apps {

enum class CompareFormat : std::uint8_t { text, json };

struct CompareOptions {
  /// Two pictures, two files of counters, which end in .json, or two pages of renders, which end in .html.
  std::filesystem::path a, reference;
  std::optional<std::filesystem::path> difference;  ///< output: the picture |A - B|
  std::optional<std::filesystem::path> flip;        ///< output: the picture of perceived differences
  CompareFormat format = CompareFormat::text;
  std::vector<Limit> limits = {};                    ///< for pictures
  FigureChoice figures = {};                         ///< for counters
  std::optional<std::filesystem::path> report = {};  ///< output: the page of both runs, for two pages
  Sandbox sandbox = Sandbox::available;              ///< for the pictures' reader
};

void add_options(OptionSet options, CompareOptions& compare);

/// Reads both, writes the requested pictures or page, and prints to `output` the figures of PictureError, or the counters that
/// differ. A signal ends the process. Returns differs_status, with a sentence on stderr, if a limit is exceeded or a counter
/// differs, else 0. Throws core::UsageError if a picture would replace another one of them, core::InputError if a file cannot be
/// read or something cannot be written, Interrupted if a signal came before.
int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

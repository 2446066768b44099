// The command `compare`: how far two pictures lie apart, in which counters two runs differ, or both on one clock.
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
  std::optional<std::filesystem::path> difference;  ///< where the picture |A - B| goes
  std::optional<std::filesystem::path> flip;        ///< where the picture of perceived differences goes
  CompareFormat format = CompareFormat::text;
  std::vector<Limit> limits = {};                    ///< for pictures
  FigureChoice figures = {};                         ///< for counters
  std::optional<std::filesystem::path> report = {};  ///< where the page of both runs goes, of two pages
  Sandbox sandbox = Sandbox::available;              ///< for the pictures' reader
};

/// Declares them.
void add_options(OptionSet options, CompareOptions& compare);

/// Reads both, writes the pictures or the page asked for, prints to `output` the figures of PictureError, or the counters that
/// differ. A signal ends the process. Returns differs_status, with a sentence on stderr, where a limit is passed or a counter
/// differs, else 0. Throws core::UsageError if a picture would replace another one of them, core::InputError if a file cannot be
/// read or something cannot be written, Interrupted if a signal came before.
int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

// The command `compare`: how far two pictures lie apart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "apps/line/command_line.h"
#include "apps/system/interrupt.h"

namespace dmpc::apps {

enum class CompareFormat : std::uint8_t { text, json };

struct CompareOptions {
  std::filesystem::path picture;                    ///< A
  std::filesystem::path reference;                  ///< B
  std::optional<std::filesystem::path> difference;  ///< where the picture |A - B| goes
  std::optional<std::filesystem::path> flip;        ///< where the picture of perceived differences goes
  CompareFormat format = CompareFormat::text;
};

/// Declares them.
void add_options(OptionSet options, CompareOptions& compare);

/// Reads both, writes the pictures asked for, prints the figures of PictureError to `output`: as lines of text, or as one JSON
/// object in which what is infinite is null. A signal ends the process. Returns the exit status 0. Throws core::UsageError if a
/// picture would replace another one of them, core::InputError if one cannot be read or something cannot be written, Interrupted
/// if a signal came before.
int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

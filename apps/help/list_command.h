// The command `list`: what there is to choose from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

enum class ListFormat : std::uint8_t { text, json };

struct ListOptions {
  std::vector<std::string> kinds;  ///< in the order in which they are printed; none: all
  ListFormat format = ListFormat::text;
  std::optional<std::filesystem::path> pictures;  ///< the folder where pictures of the scenes go
};

/// Declares them; a kind that there is none is a core::UsageError, and so are pictures of anything but scenes.
void add_options(OptionSet options, ListOptions& list);

/// Writes the pictures that are asked for, as write_gallery() does, then prints the lists to `output`. Returns the exit status 0.
int list_command(const ListOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

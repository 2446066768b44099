// The command `list`: what there is to choose from.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/edge/line/command_line.h"

namespace dmpc::apps {

enum class ListFormat : std::uint8_t { text, json };

struct ListOptions {
  std::vector<std::string> kinds;  ///< in the order in which they are printed; none: all
  ListFormat format = ListFormat::text;
};

/// Declares them; a kind that there is none is a core::UsageError.
void add_options(OptionSet options, ListOptions& list);

/// Prints the lists to `output`. Returns the exit status 0.
int list_command(const ListOptions& options, std::ostream& output);

}  // namespace dmpc::apps

// The study `decades`: what should travel on machines of 1988 to 2025. It is a program in Python, apps/python/dmpc/decades.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

struct DecadesOptions {
  std::vector<std::string> words;  ///< for the program in Python
  bool is_quick = false;
  bool quiet = false;  ///< no progress
};

void add_options(OptionSet set, DecadesOptions& options);

/// Does not return; throws as become_python() does.
int study_decades_command(const DecadesOptions& options, std::ostream& output);

}  // namespace dmpc::apps

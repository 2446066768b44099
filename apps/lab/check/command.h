// The command `check`: compares every ray of a render with the Embree oracle and the double-precision referee, and the file's
// positions with the oracle's own reading.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct CheckOptions {
  PictureOptions picture;
  DatabaseOptions database;
  std::uint32_t list = 10;        ///< maximum number of differences printed in full
  std::uint64_t brute_force = 0;  ///< rays of the render that the referee judges whether they differ or not
  std::uint64_t certify = 0;      ///< hits of the render whose certificates are checked against rational arithmetic
  std::string certify_text;       ///< `certify` as typed; empty: not given
  bool quiet = false;             ///< no progress
};

void add_options(OptionSet options, CheckOptions& check);

/// Prints the report to stdout, remarks and progress to stderr. A signal ends the process. Returns the exit status: 0 if no
/// difference is unexplained, no certificate fails and no pixel sees another position, 3 otherwise. Throws core::InputError for a
/// scene that cannot be read or a report that cannot be written, Interrupted if a signal came before.
int check_command(const CheckOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

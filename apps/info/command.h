// The command `info`: describes a scene and what a render of it would require, without rendering it.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/run/systems.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"
#include "dataflow/regions/balance.h"
#include "svm/page_options.h"

namespace dmpc::apps {

struct InfoRecord;

enum class InfoFormat : std::uint8_t { text, json };

struct InfoOptions {
  PictureOptions picture;
  DatabaseOptions database;
  std::vector<std::uint32_t> node_counts = {1, 2, 4, 8, 16, 32, 64, 128, 256};    ///< ascending
  dataflow::BalanceOptions balance = {.balance = dataflow::Balance::equal_size};  ///< the default does not render anything
  std::optional<System> system;                                                   ///< whose database and pages are examined
  svm::PageOptions pages;                                                         ///< for svm
  InfoFormat format = InfoFormat::text;
  bool quiet = false;  ///< no progress and no notes from the scene's reader
};

void add_options(OptionSet options, InfoOptions& info);

/// Reads the scene and builds the database, as render does, and collects the record. Throws core::InputError and core::UsageError
/// for the scene as render_command() does.
InfoRecord find_out(const InfoOptions& options);

/// Collects the record and prints it to `output`. A signal ends the process. Returns the exit status 0. Throws the exceptions of
/// find_out(), core::InputError if the output cannot be written, and Interrupted if a signal came before.
int info_command(const InfoOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

// The command `info`: what a scene is, and what a render of it would take, without rendering it.
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
  dataflow::BalanceOptions balance = {.balance = dataflow::Balance::equal_size};  ///< that nothing be rendered unasked
  std::optional<System> system;                                                   ///< whose database and pages are looked at
  svm::PageOptions pages;                                                         ///< for svm
  InfoFormat format = InfoFormat::text;
  bool quiet = false;  ///< no progress and no remarks of the scene's reader
};

/// Declares them.
void add_options(OptionSet options, InfoOptions& info);

/// Reads and builds, as render does, and looks. Throws core::InputError and core::UsageError as render_command() does for the
/// scene.
InfoRecord find_out(const InfoOptions& options);

/// Finds out and prints to `output`. A signal ends the process. Returns the exit status 0. Throws as
/// find_out() does, core::InputError if the output cannot be written, Interrupted if a signal came before.
int info_command(const InfoOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps

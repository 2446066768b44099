// What is taken from a process that reads foreign files, as far as this computer can take it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

/// What holds of one process, or of several together.
struct Confinement {
  bool are_calls_filtered = false;   ///< seccomp refuses it all calls of the system but a few
  bool are_limits_set = false;       ///< limits of memory, files and processes
  bool are_files_forbidden = false;  ///< Landlock lets it open none, whatever calls it may make

  bool is_reach_forbidden = false;  ///< and by Landlock's later versions TCP, devices, others' signals and abstract sockets
  bool ends_with_dmpc = false;      ///< however that ends

  /// A filter of calls takes what is reached, too, so Landlock need not.
  bool is_full() const { return are_calls_filtered && are_limits_set && are_files_forbidden && ends_with_dmpc; }
};

/// What is asked of this computer before a reader gets a byte of a foreign file.
enum class Sandbox : std::uint8_t {
  none,       ///< its matter is ours
  available,  ///< what it cannot do is said
  required    ///< where it cannot do all nothing is read
};

/// Declares --sandbox.
void add_sandbox_option(OptionSet options, Sandbox& sandbox);

/// "this computer does not confine the processes that read foreign files as it should: neither ... nor ...".
/// Requires that something is missing.
std::string missing_text(const Confinement& confinement);

/// Counts a reader that this process has started. Not thread-safe, as readers are started by one thread.
void add_reader(const Confinement& confinement);
/// What holds of all readers that this process has started; nothing if there were none.
std::optional<Confinement> confinement_of_readers();

}  // namespace dmpc::apps

// The confinement of a process that reads foreign files, as far as this computer supports it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::apps {

/// The confinement of one process, or the common one of several.
struct Confinement {
  bool are_calls_filtered = false;   ///< seccomp allows only a few system calls
  bool are_limits_set = false;       ///< limits of memory, files and processes
  bool are_files_forbidden = false;  ///< Landlock forbids opening files, whatever calls are allowed

  bool is_reach_forbidden = false;  ///< and by Landlock's later versions TCP, devices, others' signals and abstract sockets
  bool ends_with_dmpc = false;      ///< however dmpc ends

  /// A filter of calls restricts resources, too, so Landlock need not.
  bool is_full() const { return are_calls_filtered && are_limits_set && are_files_forbidden && ends_with_dmpc; }
};

/// The confinement required before a reader gets a byte of a foreign file.
enum class Sandbox : std::uint8_t {
  none,       ///< the files are trusted
  available,  ///< missing parts are reported
  required    ///< nothing is read if a part is missing
};

/// Declares --sandbox.
void add_sandbox_option(OptionSet options, Sandbox& sandbox);

/// "this computer does not confine the processes that read foreign files as it should: neither ... nor ...".
/// Requires that something is missing.
std::string missing_text(const Confinement& confinement);

/// Counts a reader that this process has started. Not thread-safe, as readers are started by one thread.
void add_reader(const Confinement& confinement);
/// The common confinement of all readers that this process has started; nothing if there were none.
std::optional<Confinement> confinement_of_readers();

}  // namespace dmpc::apps

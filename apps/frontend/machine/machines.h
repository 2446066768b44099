// The machine presets: their figures, with sources and certainty.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/database/structure.h"
#include "nodes/charge.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// The keys of a machine file that have a source, in order; cached_lookup is one of those in operation_ps.
inline constexpr std::array<std::string_view, 11> sourced_keys = {
    "topology", "uplinks",    "switching",    "short_bytes_max", "short_message",  "long_message",
    "hop_ns",   "service_ns", "operation_ps", "cached_lookup",   "has_memory_port"};

/// The presets, each a file in presets/: from ipsc2 of 1988 to ndr of 2025.
inline constexpr std::array<std::string_view, 11> machine_names = {"ipsc2",   "ipsc2-1994", "ipsc860", "paragon", "cm5", "cs2",
                                                                   "myrinet", "fdr",        "gigabit", "hdr",     "ndr"};

/// A machine and the sources of its figures.
struct MachineDescription {
  nodes::Machine machine;
  /// Some of sourced_keys, each with a sentence on its source and certainty.
  std::vector<std::pair<std::string, std::string>> sources;
  std::string title = {};  ///< a description in one line; empty for a user's machine
};

/// All of machine_names, which takes a millisecond. Thread-safe.
const std::vector<MachineDescription>& machine_presets();
/// Null if no preset has this name. Thread-safe.
const MachineDescription* find_machine_preset(std::string_view name);
/// "ipsc2, ipsc2-1994, ..., ndr", for messages.
std::string machine_preset_names();

/// The machine's name and what is special about its links, if anything is: "ipsc2", "ipsc2 without contention" or "ipsc2 with
/// memory ports". Thread-safe.
std::string name_with_links(const nodes::Machine& machine);

/// The bit of a structure in nodes::Machine::prices_for.
constexpr std::uint32_t price_bit(core::Structure structure) { return 1U << static_cast<unsigned>(structure); }
/// Whether the machine says that its prices are for this structure.
inline bool is_priced_for(const nodes::Machine& machine, core::Structure structure) {
  return (machine.prices_for & price_bit(structure)) != 0;
}
/// The names of those bits; none if the machine does not say it.
std::vector<std::string_view> priced_structures(const nodes::Machine& machine);
/// A sentence that the machine's prices are for other structures than this one; empty if they are not, or not said to be.
std::string price_note(const nodes::Machine& machine, core::Structure structure);

/// What the operations cost on a processor that takes `slowdown` times as long as the core on which core/trace/work.cpp's
/// prices were measured, in picoseconds by core::Charge. Thread-safe.
std::array<std::uint64_t, nodes::charge_count> operation_costs_ps(std::uint64_t slowdown);

}  // namespace dmpc::apps

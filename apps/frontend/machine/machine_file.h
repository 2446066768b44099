// Machines as JSON: printed, read, and found by name. Its .cpp and those of the counters name nlohmann-json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "apps/frontend/machine/machines.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// All of a machine, by keys that are an interface, with units last:
///   name               1 to 64 characters
///   topology           crossbar, hypercube, mesh, torus or fat-tree
///   uplinks            of a switch of a fat tree, 1 to 4; 1 elsewhere
///   switching          circuit or packet: what a message holds of its way
///   short_bytes_max    longer messages, header included, are long
///   short_message, long_message   send_ns, latency_ns, receive_ns, byte_ps
///   hop_ns             for each link
///   service_ns         of an interrupt, beside receiving and sending
///   operation_ps       by the names of core::Charge
///   has_contention     whether a link carries one message at a time
///   has_memory_port    whether a node sends one message at a time and receives one at a time, over whatever links; goes with
///                      has_contention only
///   prices_for         the structures, of grid, extents and voxels, that operation_ps was measured with or fitted to
nlohmann::ordered_json machine_json(const nodes::Machine& machine);

/// machine_json() and "sources", an object of texts by sourced_keys; indented, with a line end.
std::string machine_text(const MachineDescription& description);

/// Reads what machine_text() writes. "prices_for" and "sources" may be missing, any other key may not. Throws core::InputError,
/// naming `file`, the place or key and what was expected, for anything else: no JSON, unknown, missing and repeated keys, wrong
/// types, numbers that are not whole or out of range (times to 1 s, operations to 0.1 s, bytes to 1 ms), memory ports without
/// contention, uplinks without switches.
MachineDescription parse_machine(std::string_view text, const std::string& file);

/// Reads such a machine with its "title". Throws core::InternalError for what parse_machine() refuses.
MachineDescription parse_preset(std::string_view text);

/// The preset with this name, or the machine in the file of that name, 1 MiB at most. Throws core::InputError if there is
/// neither, or as parse_machine() does.
MachineDescription load_machine(const std::string& name_or_file);

}  // namespace dmpc::apps

// What a message on its way holds of a machine's network.
#pragma once

#include <cstdint>
#include <string_view>

namespace dmpc::nodes {

/// circuit: each link of the way, from when its header has it until the whole message has arrived, so that a header which waits
/// keeps what is behind it (S. Nugent, "The iPSC/2 Direct-Connect Communications Technology", 1988). packet: each link for as
/// long as its own bytes pass it, so that what waits for one link leaves the others to others; the header does not wait for the
/// tail (P. Kermani, L. Kleinrock, "Virtual Cut-Through: A New Computer Communication Switching Technique", 1979), and routers
/// have room for what waits.
enum class Switching : std::uint8_t { circuit, packet };

/// "circuit" or "packet".
std::string_view name_of(Switching switching);
/// A name read back; throws core::InputError, listing the names, for anything else.
Switching parse_switching(std::string_view name);

}  // namespace dmpc::nodes

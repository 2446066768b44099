// What the real computer has, and what else it does, while something is timed on it.
#pragma once

#include <cstdint>
#include <string>

namespace dmpc::apps {

/// Cores that are at work in the real computer; at least 1.
std::uint32_t core_count();

/// The load of the last minute; 0 where the system does not say.
double machine_load();

/// A sentence with the load `before` and the load now.
std::string load_note(double before);

}  // namespace dmpc::apps

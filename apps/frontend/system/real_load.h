// Cores and load of the real computer, for measurements.
#pragma once

#include <cstdint>
#include <string>

namespace dmpc::apps {

/// Returns the number of online cores of the real computer; at least 1.
std::uint32_t core_count();

/// Returns the load average of the last minute; 0 where it is unknown.
double machine_load();

/// Returns a sentence with the load `before` and the load now.
std::string load_note(double before);

}  // namespace dmpc::apps

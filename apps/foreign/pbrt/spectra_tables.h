// Tabulated data of standards and measurements for named spectra.
#pragma once

#include <string_view>
#include <vector>

namespace dmpc::apps::pbrt {

/// The numbers of a row of spectra.txt, of the kind "observer", "daylight", "light", "metal" or "glass"; nullptr if there is
/// none. Thread-safe.
const std::vector<double>* tabulated(std::string_view kind, std::string_view name);

}  // namespace dmpc::apps::pbrt

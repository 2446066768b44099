// The floating-point environment that all pictures are computed in: round to nearest, denormals kept.
#pragma once

#include <cfenv>

namespace dmpc::core {

/// Restores the default floating-point environment of this thread. A library built for speed may flush denormals to zero in the
/// thread that loads it, and therefore in threads started from that one. Call it at the start of a thread whose results matter,
/// and after loading libraries.
inline void use_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

}  // namespace dmpc::core

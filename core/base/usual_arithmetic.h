// The arithmetic by which every picture is made: rounded to nearest, with numbers however tiny.
#pragma once

#include <cfenv>

namespace dmpc::core {

/// Restores the default floating-point environment of this thread: a library that was built for speed may flush denormals to zero
/// in the thread that loads it, and so in those started from there. To be called at the start of a thread whose results matter,
/// and after loading libraries.
inline void use_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

}  // namespace dmpc::core

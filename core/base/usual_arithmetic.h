// The arithmetic by which every picture is made: rounded to nearest, with numbers however tiny.
#pragma once

#include <cfenv>

namespace dmpc::core {

/// Gives it to this thread, whatever it has: a library that was built for speed makes tiny numbers zero for the thread that loads
/// it, and so for those that are started from there. To be called at the start of a thread whose numbers count, and behind what
/// loads libraries.
inline void use_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

}  // namespace dmpc::core

// What share of a picture's pixels has the same 8 bits in float and in double, if all is well.
#pragma once

#include <string>

namespace dmpc::apps {

/// In percent of the pixels.
struct Expectation {
  double percent = 0;
  std::string reason;  ///< why no more
};

/// "99.5": a number from 0 to 100. Throws core::UsageError naming --expect for anything else.
double parse_expectation(const std::string& text);

/// Of a scene by its name. A family's own scene has what was measured of it, at 256x256 pixels and depth 5, in whole hundredths
/// of a percent; any other has 99 %. Deeper pictures count as any other.
Expectation expectation_of(const std::string& scene, int depth);

}  // namespace dmpc::apps

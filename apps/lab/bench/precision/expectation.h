// What share of a picture's pixels has the same 8 bits in float and in double, if all is well.
#pragma once

#include <string>

namespace dmpc::apps {

inline constexpr int measured_side = 256, measured_depth = 5;

/// In percent of the pixels.
struct Expectation {
  double percent = 0;
  std::string reason;  ///< why no more
};

/// "99.5": a number from 0 to 100. Throws core::UsageError naming --expect for anything else.
double parse_expectation(const std::string& text);

/// Of any scene: 99 %.
Expectation usual_expectation();

/// Of a family's own scene, by its name: what was measured of it at `measured_side` x `measured_side` pixels and depth
/// `measured_depth`, seen and lit as it is, in whole hundredths of a percent. Of any other the usual.
Expectation expectation_of(const std::string& scene);

}  // namespace dmpc::apps

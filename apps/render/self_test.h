// A number that two builds of dmpc, or two processors, agree on if they come to the same pictures.
#pragma once

#include <cstdint>

#include "apps/frontend/ranks/compatibility.h"

namespace dmpc::apps {

/// The bytes of two small databases and the light that some 10^4 rays find there, one by one and in bundles, by the kernels that
/// are used on this processor.
struct SelfTest {
  std::uint64_t databases = 0, pictures = 0;
};
SelfTest self_test();

/// What ranks that render must have in common: the build, the words, and what the test came to.
Compatibility renderer_compatibility();

}  // namespace dmpc::apps

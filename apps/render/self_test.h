// A self-test, whose result is the same for builds of dmpc and processors that compute the same pictures.
#pragma once

#include <cstdint>

#include "apps/frontend/ranks/compatibility.h"

namespace dmpc::apps {

/// Digests of two small databases and of the light that some 10^4 rays find in them, one by one and in bundles, by the kernels
/// for this processor.
struct SelfTest {
  std::uint64_t databases = 0, pictures = 0;
};
SelfTest self_test();

/// Compatibility of ranks that render: the build, the command line, and the result of the self-test.
Compatibility renderer_compatibility();

}  // namespace dmpc::apps

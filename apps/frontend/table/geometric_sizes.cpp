#include "apps/frontend/table/geometric_sizes.h"

#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::vector<std::uint32_t> geometric_sizes(std::uint32_t most, std::uint32_t count) {
  core::expect(count >= 2, "sizes go from one to another");
  if (most == 0) {
    return {};
  }
  std::vector<std::uint32_t> sizes;
  const double step = core::natural_log(most) / (count - 1);
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const auto size = static_cast<std::uint32_t>(core::exponential(i * step) + 0.5);
    if (sizes.empty() || size > sizes.back()) {
      sizes.push_back(size);
    }
  }
  if (sizes.back() < most) {
    sizes.push_back(most);
  }
  return sizes;
}

}  // namespace dmpc::apps

#include "apps/frontend/system/real_load.h"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {

std::uint32_t core_count() { return static_cast<std::uint32_t>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN))); }

double machine_load() {
  std::array<double, 1> load{};
  return ::getloadavg(load.data(), 1) == 1 ? load[0] : 0;
}

std::string load_note(double before) {
  return "Load of the machine, whose cores are " + std::to_string(core_count()) + ": " + fixed(before, 1) + " before, " +
         fixed(machine_load(), 1) + " after.";
}

}  // namespace dmpc::apps

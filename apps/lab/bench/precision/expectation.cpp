#include "apps/lab/bench/precision/expectation.h"

#include <algorithm>
#include <array>

#include "apps/edge/line/option_values.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

struct FamilyExpectation {
  const char* scene;
  double percent;
  const char* reason;
};

constexpr const char* by_mirrors = "mirrors multiply what rounding leaves at each bounce";
constexpr const char* by_steps = "colours lie next to a step of 8 bits";
constexpr const char* by_nothing = "nothing is rounded by a step of 8 bits";

constexpr std::array<FamilyExpectation, 11> family_expectations = {{{"balls-4", 99.92, by_mirrors},
                                                                    {"gears-4", 99.99, by_steps},
                                                                    {"jacks-1", 100, by_nothing},
                                                                    {"lattice-12", 99.96, by_mirrors},
                                                                    {"mount-6", 99.99, by_steps},
                                                                    {"rings-7", 99.92, by_mirrors},
                                                                    {"shells-5", 99.94, by_mirrors},
                                                                    {"sombrero-1", 100, by_nothing},
                                                                    {"teapot-12", 99.99, by_steps},
                                                                    {"tetra-6", 100, by_nothing},
                                                                    {"tree-11", 99.99, by_steps}}};

}  // namespace

double parse_expectation(const std::string& text) {
  const double percent = finite_number(text);
  if (!(percent >= 0 && percent <= 100)) {
    throw core::UsageError("--expect=" + text + ": expected a percentage from 0 to 100, such as 99.5");
  }
  return percent;
}

Expectation usual_expectation() { return {99, "what is expected of any scene"}; }

Expectation expectation_of(const std::string& scene) {
  const auto* const found = std::find_if(family_expectations.begin(), family_expectations.end(),
                                         [&](const FamilyExpectation& family) { return family.scene == scene; });
  return found == family_expectations.end() ? usual_expectation() : Expectation{found->percent, found->reason};
}

}  // namespace dmpc::apps

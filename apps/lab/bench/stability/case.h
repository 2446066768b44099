// One case of a stability test: rays of one kind against one subject.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/counts.h"
#include "apps/lab/bench/stability/random.h"

namespace dmpc::apps {

/// Shoots `count` rays from number `first` on, drawing from `random`. Thread-safe; a pure function of its arguments.
using ShootRays = std::function<KernelCounts(Random& random, std::uint64_t first, std::uint64_t count)>;

/// Shoots ray after ray: shoot_one(random, number, counts).
template <class ShootOne>
ShootRays each_ray(ShootOne shoot_one) {
  return [shoot_one = std::move(shoot_one)](Random& random, std::uint64_t first, std::uint64_t count) {
    KernelCounts counts{};
    for (std::uint64_t i = first; i < first + count; ++i) {
      shoot_one(random, i, counts);
    }
    return counts;
  };
}

struct StabilityCase {
  std::string row;                     ///< the table's row in which it counts: "R1 closed meshes". The first word is the test
  std::string name;                    ///< unique within the row
  std::uint64_t rays = 0;              ///< to be shot
  std::function<ShootRays()> prepare;  ///< builds the subject

  std::string test() const { return row.substr(0, row.find(' ')); }
};

using StabilityCases = std::vector<StabilityCase>;

/// The number of rays of each test: the same for all, or (0) each test's number of the long run.
struct StabilityAmount {
  std::uint64_t rays = 0;

  /// Returns the share of one of `case_count` cases in a row, rounded up.
  std::uint64_t share(std::uint64_t long_rays, std::uint64_t case_count) const {
    const std::uint64_t all = rays != 0 ? rays : long_rays;
    return (all + case_count - 1) / case_count;
  }
};

/// The cases of each test, one function a file.
StabilityCases mesh_cases(const StabilityAmount& amount);         ///< R1, R2, R3
StabilityCases axis_cases(const StabilityAmount& amount);         ///< R4
StabilityCases plane_cases(const StabilityAmount& amount);        ///< R5
StabilityCases insertion_cases(const StabilityAmount& amount);    ///< R6
StabilityCases scene_cases(const StabilityAmount& amount);        ///< R7, R8, R12
StabilityCases region_cases(const StabilityAmount& amount);       ///< R9
StabilityCases child_cases(const StabilityAmount& amount);        ///< R10
StabilityCases hostile_cases(const StabilityAmount& amount);      ///< R11
StabilityCases parity_cases(const StabilityAmount& amount);       ///< R14
StabilityCases certificate_cases(const StabilityAmount& amount);  ///< R16
StabilityCases quadric_cases(const StabilityAmount& amount);      ///< quadrics

}  // namespace dmpc::apps

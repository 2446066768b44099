// Judges the kernels' answers to one ray: against each other, against the referee, and against what the test knows.
#pragma once

#include "apps/lab/bench/stability/counts.h"
#include "apps/lab/bench/stability/kernels.h"

namespace dmpc::apps {

/// What a test knows of a ray before it is shot.
struct StabilityExpectation {
  enum class Must : std::uint8_t { either, hit, miss };

  Must must = Must::either;         ///< by geometry: rays that start in a closed body hit
  bool to_referee = false;          ///< use brute force even if all kernels agree
  const core::Hit* bits = nullptr;  ///< exact bits of the grid kernels' answer; if not set, those that `grid` answers
};

/// Counts `ray` and its answers. A kernel that disagrees with another one (or is sampled) is judged by the referee, which shares
/// no code with the kernels: brute force in double precision, in long double where a sign is in doubt and for curved primitives.
/// Its bounds for Embree are those of the robust mode.
void judge(const StabilitySubject& subject, const core::Ray& ray, const StabilityAnswers& answers,
           const StabilityExpectation& expectation, KernelCounts& counts);

}  // namespace dmpc::apps

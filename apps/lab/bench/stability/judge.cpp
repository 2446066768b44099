#include "apps/lab/bench/stability/judge.h"

#include <cmath>

#include "apps/lab/bench/stability/hearing.h"
#include "apps/lab/bench/stability/own_kernels.h"
#include "apps/lab/bench/stability/rays.h"

namespace dmpc::apps {
namespace {

using core::Hit;
using core::Ray;
using Kernel = StabilityKernel;
using Must = StabilityExpectation::Must;

Renderer renderer_of(Kernel kernel) { return is_embree(kernel) ? Renderer::embree : Renderer::grid; }

bool level(const Hit& a, const Hit& b) { return std::fabs(double{a.t} - double{b.t}) <= level_share * std::fabs(double{b.t}); }

/// Returns whether all kernels agree, or name primitives that the ray meets at about one distance: then the grid's answer, which
/// is sampled, stands for all. A miss of a ray that must hit needs no judge.
bool agree(const StabilitySubject& subject, const Ray& ray, const StabilityAnswers& answers, Must must) {
  const Hit& grid = answers[index_of(Kernel::grid)];
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const Hit& hit = answers[k];
    const auto kernel = static_cast<Kernel>(k);
    if (!hit.found() || !grid.found() || kernel == Kernel::any_hit) {
      if (hit.found() != grid.found() && (hit.found() || must != Must::hit)) {
        return false;
      }
    } else if (!level(hit, grid) ||
               (hit.primitive != grid.primitive && !subject.referee.examine(ray, hit.primitive).possible(renderer_of(kernel)))) {
      return false;
    }
  }
  return true;
}

bool same_bits(Kernel kernel, const Hit& hit, const Hit& expected) {
  return kernel == Kernel::any_hit ? hit.found() == expected.found() : same_hit(hit, expected);
}

}  // namespace

void judge(const StabilitySubject& subject, const Ray& ray, const StabilityAnswers& answers,
           const StabilityExpectation& expectation, KernelCounts& counts) {
  const Hearing nearest(subject.database, subject.referee, of_kind(ray, core::RayKind::reflected)),
      any(subject.database, subject.referee, of_kind(ray, core::RayKind::shadow));
  const Hit& grid = answers[index_of(Kernel::grid)];
  const Hit& expected = expectation.bits != nullptr ? *expectation.bits : grid;
  const bool heard = expectation.to_referee || !agree(subject, ray, answers, expectation.must);
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const auto kernel = static_cast<Kernel>(k);
    const Hit& hit = answers[k];
    StabilityCounts& count = counts[k];
    ++count.tried;
    count.sure_hits += expectation.must == Must::hit ? 1 : 0;
    count.sure_misses += expectation.must == Must::miss ? 1 : 0;
    count.heard += heard ? 1 : 0;
    if (!hit.found() && expectation.must == Must::hit) {
      ++count.leaks;
    } else if (hit.found() && expectation.must == Must::miss) {
      ++count.wrong_hits;
    } else if (heard && !(kernel == Kernel::any_hit ? any : nearest).admissible(hit, renderer_of(kernel))) {
      ++(hit.found() ? count.wrong_hits : count.leaks);
    } else if ((!is_embree(kernel) && !same_bits(kernel, hit, expected)) ||
               (heard && hit.found() && kernel != Kernel::any_hit && !nearest.distance_explained(hit))) {
      ++count.unexplained;
    } else if (is_embree(kernel) && hit.primitive != grid.primitive) {
      ++count.explained;
    }
  }
}

}  // namespace dmpc::apps

// R5: the sequence of finest cells from the traversal's planes, against the true line in long double: each point at which it
// enters a cell lies in that cell within the pad, each step leads to a neighbour, and forward.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>

#include "apps/lab/bench/stability/bodies.h"
#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/scene/frame.h"
#include "core/trace/traversal.h"

namespace dmpc::apps {
namespace {

using core::Corner;
using core::Passage;
using core::Ray;
using Vec3l = core::Vec3<long double>;

/// Returns the largest distance over the axes of the line at `t` from the finest cell; the product of a float and an integer is
/// exact in long double, and the line's points are off by 2^-63 of their size.
long double distance_from(const Ray& ray, const core::GridFrame& frame, const Corner& cell, double t) {
  const Vec3l at = Vec3l(ray.origin) + Vec3l(ray.direction) * static_cast<long double>(t);
  const auto edge = static_cast<long double>(frame.finest_cell);
  long double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double low = static_cast<long double>(frame.low[axis]) + edge * static_cast<long double>(cell[axis]);
    most = std::max({most, low - at[axis], at[axis] - low - edge});
  }
  return most;
}

/// Returns whether `to` is the neighbour of `from` on the side to which the ray goes.
bool is_step_forward(const Ray& ray, const Corner& from, const Corner& to) {
  int changed = 0;
  bool forward = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t step = to[axis] - from[axis];
    changed += std::abs(step);
    forward = forward && (step == 0 || (step > 0) == (ray.direction[axis] > 0.0F));
  }
  return changed == 1 && forward;
}

/// The whole line: if it passes through the grid's middle, no traversal may miss it.
class Sequence {
 public:
  Sequence(const core::GridFrame& frame, double pad) : frame_(frame), pad_(pad) {}

  /// Follows the ray from its first cell to the grid's end.
  void follow(const Ray& ray, StabilityCounts& count) const {
    std::optional<Passage> passage = first_passage(ray, frame_);
    ++count.tried;
    if (!passage) {
      ++count.leaks;  // aimed at a point inside
      return;
    }
    const Corner size = core::grid_size(frame_);
    core::Operations operations;
    for (std::int32_t steps = 0; steps <= size[0] + size[1] + size[2] + 3; ++steps) {
      const Passage before = *passage;
      if (distance_from(ray, frame_, before.cell, before.t_enter) > pad_) {
        ++count.unexplained;
        return;
      }
      const Corner high{before.cell[0] + 1, before.cell[1] + 1, before.cell[2] + 1};
      if (pass(ray, frame_, {before.cell, high}, *passage, operations) != core::Traced::left) {
        return;
      }
      if (!is_step_forward(ray, before.cell, passage->cell) || passage->t_enter < before.t_enter) {
        ++count.wrong_hits;
        return;
      }
    }
    ++count.unexplained;  // did not end
  }

 private:
  core::GridFrame frame_;
  double pad_;
};

ShootRays plane_rays() {
  const auto database = std::make_shared<const core::Database>(core::build_database(fine_sphere().scene, {}));
  return each_ray([database](Random& random, std::uint64_t, KernelCounts& counts) {
    const core::GridFrame& frame = database->header().frame;
    const Sequence sequence(frame, database->pad());
    const double reach = random.bits() % 2 == 0 ? 0.9 : 4.0;
    const Ray ray = ray_through(to_local(frame, random.direction() * reach), to_local(frame, random.in_box(-0.9, 0.9)));
    sequence.follow(ray, counts[index_of(StabilityKernel::planes)]);
  });
}

}  // namespace

StabilityCases plane_cases(const StabilityAmount& amount) {
  return {{"R5 sequence of cells", "fine sphere", amount.share(10'000'000, 1), plane_rays}};
}

}  // namespace dmpc::apps

#include "apps/frontend/machine/voxel_prices.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "apps/frontend/machine/machines.h"
#include "core/trace/charge.h"
#include "core/trace/work.h"

namespace dmpc::apps {

void set_prices(nodes::Machine& machine, const VoxelPrices& prices) {
  using core::Charge;
  const core::WorkPrices& measured = core::measured_prices;
  const auto set = [&](Charge charge, double factor, std::uint64_t measured_ps) {
    machine.cost_ps[static_cast<std::size_t>(charge)] =
        static_cast<std::uint64_t>(std::llround(factor * static_cast<double>(measured_ps)));
  };
  set(Charge::cell_step, prices.walk, measured.cell_step_ps);
  set(Charge::bvh_node_read, prices.walk, measured.bvh_node_read_ps);
  set(Charge::triangle_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[0]);
  set(Charge::sphere_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[1]);
  set(Charge::cone_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[2]);
  set(Charge::ray_setup, prices.rays, measured.ray_ps);
  set(Charge::shading, prices.rays, measured.shading_ps);
  set(Charge::cached_lookup, prices.cached_lookup, operation_costs_ps(1)[static_cast<std::size_t>(Charge::cached_lookup)]);
}

}  // namespace dmpc::apps

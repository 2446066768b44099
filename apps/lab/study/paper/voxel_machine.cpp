#include "apps/lab/study/paper/voxel_machine.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "apps/frontend/machine/machines.h"
#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "core/trace/work.h"

namespace dmpc::apps {
namespace {

using core::Charge;

std::uint64_t scaled_price(double factor, std::uint64_t measured_ps) {
  return static_cast<std::uint64_t>(std::llround(factor * static_cast<double>(measured_ps)));
}

}  // namespace

nodes::Machine voxel_machine(const VoxelPrices& prices) {
  const MachineDescription* const preset = find_machine_preset("ipsc2");
  core::expect(preset != nullptr, "the machine of the article has a preset");
  nodes::Machine machine = preset->machine;
  machine.name = "ipsc2 with the prices of voxels";
  const core::WorkPrices& measured = core::measured_prices;
  const auto set = [&](Charge charge, double factor, std::uint64_t measured_ps) {
    machine.cost_ps[static_cast<std::size_t>(charge)] = scaled_price(factor, measured_ps);
  };
  set(Charge::cell_step, prices.walk, measured.cell_step_ps);
  set(Charge::bvh_node_read, prices.walk, measured.bvh_node_read_ps);
  set(Charge::triangle_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[0]);
  set(Charge::sphere_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[1]);
  set(Charge::cone_test, prices.walk, measured.bvh_node_read_ps + measured.primitive_test_ps[2]);
  set(Charge::ray_setup, prices.rays, measured.ray_ps);
  set(Charge::shading, prices.rays, measured.shading_ps);
  set(Charge::cached_lookup, prices.cached_lookup, operation_costs_ps(1)[static_cast<std::size_t>(Charge::cached_lookup)]);
  return machine;
}

}  // namespace dmpc::apps

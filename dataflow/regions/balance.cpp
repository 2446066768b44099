#include "dataflow/regions/balance.h"

#include <cmath>

#include "core/picture/camera/subsample.h"
#include "dataflow/regions/charged_picture.h"

namespace dmpc::dataflow {
namespace {

/// The resolution of the lattice for loads.
constexpr std::int32_t columns_per_side = 256;

void check(const BalanceOptions& options) {
  if (options.subsample < 1) {
    throw core::UsageError("a subsampled picture takes one pixel of every 1x1 or more");
  }
  if (options.regions_a_node < 1) {
    throw core::UsageError("a node has a region or more");
  }
  if (options.balance == Balance::moving && options.regions_a_node < 2) {
    throw core::UsageError("a node whose region moves has 2 units of it or more, not 1");
  }
}

}  // namespace

CutAxes axes_facing(const core::Camera& camera) {
  // The common part of the directions of opposite corners of the picture is the camera's viewing direction.
  const core::Vec3f first = camera.primary_ray(0, 0).direction, last = camera.primary_ray(camera.pixel_count() - 1, 0).direction;
  const core::Vec3f forward = first + last;
  std::size_t along = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    along = std::fabs(forward[axis]) > std::fabs(forward[along]) ? axis : along;
  }
  return along == 0 ? CutAxes{1, 2} : along == 1 ? CutAxes{0, 2} : CutAxes{0, 1};
}

ColumnLoads measure_loads(const core::Database& database, const core::RenderSettings& settings, const ColumnLattice& lattice,
                          const std::vector<std::uint32_t>& pixels, const std::stop_token& stop) {
  ColumnLoads loads(lattice);
  const auto charge = [&](const core::Corner& cell, std::uint64_t work) { loads.load[lattice.column_of(cell)] += work; };
  ChargedPicture picture(database, settings, charge);
  for (std::size_t index = 0; index < pixels.size() && !stop.stop_requested(); ++index) {
    picture.render(pixels[index]);
  }
  return loads;
}

ColumnLoads column_loads(const core::Database& database, const core::RenderSettings& settings, const BalanceOptions& options,
                         const std::stop_token& stop) {
  check(options);
  const core::Camera& camera = settings.camera;
  const ColumnLattice lattice(core::grid_size(settings.header.frame), axes_facing(camera), columns_per_side);
  return !options.is_by_load() ? ColumnLoads(lattice)
                               : measure_loads(database, settings, lattice,
                                               core::subsampled_pixels(camera.width(), camera.height(), options.subsample), stop);
}

Balanced share_out(const ColumnLoads& loads, std::uint32_t node_count, const BalanceOptions& options) {
  const ColumnLattice& lattice = loads.lattice;
  if (options.balance == Balance::scattered) {
    const Scattered regions = scatter(lattice.grid_size(), lattice.axes(), node_count, options.regions_a_node);
    return {regions, std::vector<double>(regions.region_count(), 0.0)};
  }
  if (options.balance == Balance::equal_size) {
    return {equal_size_bsp(lattice.grid_size(), lattice.axes(), node_count, options.bsp), std::vector<double>(node_count, 0.0)};
  }
  const Bsp bsp = options.balance == Balance::moving ? build_units(loads, node_count, options.regions_a_node, options.bsp)
                                                     : build_bsp(loads, node_count, options.bsp);
  return {bsp, loads_of_regions(bsp, loads)};
}

bool can_share_out(const ColumnLattice& lattice, std::uint32_t node_count, const BalanceOptions& options) {
  const std::uint64_t region_count = std::uint64_t{node_count} * options.regions_a_node;
  return node_count <= region_count_max && (options.balance != Balance::moving || region_count <= region_count_max) &&
         (options.balance != Balance::scattered ||
          (region_count <= Scattered::regions_max &&
           scattered_shape({lattice.size(0), lattice.size(1)}, node_count, options.regions_a_node)));
}

}  // namespace dmpc::dataflow

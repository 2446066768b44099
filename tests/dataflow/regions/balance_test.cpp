#include "dataflow/regions/balance.h"
#include "core/picture/camera/subsample.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <stop_token>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/picture/render.h"
#include "core/trace/work.h"
#include "dataflow/regions/charged_picture.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::regions_balance_test {

namespace {

using dataflow::Balance;
using dataflow::Balanced;
using dataflow::ColumnLattice;
using dataflow::ColumnLoads;
using dataflow::CutAxes;

/// A scene ready to be rendered at a small size.
struct Stage {
  core::Database database;
  core::RenderSettings settings;

  explicit Stage(const core::Scene& scene, int width = 64, int height = 64)
      : database(core::build_database(scene, apps::several_macro_cells(scene))),
        settings{database.header(), core::Camera(scene.view, database.header().frame, width, height, 1), {}} {}

  ColumnLattice lattice() const {
    return ColumnLattice(core::grid_size(settings.header.frame), dataflow::axes_facing(settings.camera), 256);
  }
  /// The loads of the whole picture.
  ColumnLoads all_loads() const {
    return measure_loads(database, settings, lattice(),
                         core::subsampled_pixels(settings.camera.width(), settings.camera.height(), 1));
  }
};

/// A ray in finest cells.
class Path {
 public:
  Path(const core::Ray& ray, const core::GridFrame& frame)
      : origin_((core::Vec3d(ray.origin) - frame.low) * (1.0 / double{frame.finest_cell})),
        direction_(core::Vec3d(ray.direction)) {}

  /// How far along the ray the middle of a finest cell lies.
  double along(const core::Corner& cell) const { return dot(middle(cell) - origin_, direction_); }
  /// From the middle of a finest cell to the ray.
  double distance_to(const core::Corner& cell) const { return length(middle(cell) - origin_ - direction_ * along(cell)); }

 private:
  static core::Vec3d middle(const core::Corner& cell) { return {cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}; }

  core::Vec3d origin_, direction_;
};

CutAxes axes_seen(const core::Vec3d& from) {
  core::Scene scene = mirrors_and_glass();
  scene.view.from = from;
  return dataflow::axes_facing(Stage(scene).settings.camera);
}

Balanced balance(const core::Database& database, const core::RenderSettings& settings, std::uint32_t region_count,
                 const dataflow::BalanceOptions& options) {
  return dataflow::share_out(dataflow::column_loads(database, settings, options), region_count, options);
}

std::uint64_t sum(const ColumnLoads& loads) { return std::accumulate(loads.load.begin(), loads.load.end(), std::uint64_t{0}); }

}  // namespace

TEST_CASE("the cuts are made along the two axes most parallel to the screen") {
  CHECK(axes_seen({0.1, -4, 0.6}) == CutAxes{0, 2});
  CHECK(axes_seen({0.1, 4, 0.6}) == CutAxes{0, 2});
  CHECK(axes_seen({5, 0.5, 0.6}) == CutAxes{1, 2});
  CHECK(axes_seen({0.1, 0.2, 6}) == CutAxes{0, 1});
}

TEST_CASE("a subsampled picture has the middle pixel of every full square") {
  CHECK(core::subsampled_pixels(16, 8, 8) == std::vector<std::uint32_t>{4 * 16 + 4, 4 * 16 + 12});
  CHECK(core::subsampled_pixels(23, 15, 8).size() == 2);
  CHECK(core::subsampled_pixels(512, 512, 8).size() == 4096);
}

TEST_CASE("a picture smaller than a square still gives one pixel") {
  CHECK(core::subsampled_pixels(1, 1, 8) == std::vector<std::uint32_t>{0});
  CHECK(core::subsampled_pixels(5, 3, 8) == std::vector<std::uint32_t>{5 + 2});
}

TEST_CASE("one pixel of every 1x1 is the whole picture") {
  const std::vector<std::uint32_t> pixels = core::subsampled_pixels(3, 2, 1);
  CHECK(pixels == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("the charged picture does the operations of the reference renderer, to the last one") {
  for (const core::Scene& scene : {mirrors_and_glass(), built_in("rings-2-t1"), built_in("tetra-4")}) {
    const Stage stage(scene);
    core::LocalRecords records(stage.database.bytes());
    core::GridTracer tracer(records, stage.database.header(), {});
    core::Operations expected;
    core::render(tracer, stage.settings, expected);
    std::uint64_t charged = 0;
    dataflow::ChargedPicture picture(stage.database, stage.settings,
                                     [&](const core::Corner&, std::uint64_t work) { charged += work; });
    for (std::uint32_t pixel = 0; pixel < stage.settings.camera.pixel_count(); ++pixel) {
      picture.render(pixel);
    }
    const core::Operations& found = picture.operations();
    CHECK(found.cell_steps == expected.cell_steps);
    CHECK(found.bvh_node_reads == expected.bvh_node_reads);
    CHECK(found.primitive_tests == expected.primitive_tests);
    CHECK(found.shadings == expected.shadings);
    CHECK(charged == core::work_of(found));
  }
}

TEST_CASE("every piece of work is charged inside the grid, and all of it is found in the columns") {
  const Stage stage(mirrors_and_glass());
  const core::Corner size = core::grid_size(stage.settings.header.frame);
  bool is_inside = true;
  std::uint64_t charged = 0;
  dataflow::ChargedPicture picture(stage.database, stage.settings, [&](const core::Corner& cell, std::uint64_t work) {
    is_inside = is_inside && core::Region{{}, size}.contains(cell);
    charged += work;
  });
  for (std::uint32_t pixel = 0; pixel < stage.settings.camera.pixel_count(); ++pixel) {
    picture.render(pixel);
  }
  CHECK(is_inside);
  CHECK(sum(stage.all_loads()) == charged);
}

TEST_CASE("the work of a ray is charged along the ray, piece by piece, and its shading where it hits") {
  core::Scene scene = built_in("tetra-5");
  scene.lights.clear();
  const Stage stage(scene);
  constexpr double overlap = 2 * core::finest_per_macro;  // of the boxes in a macro cell, that are visited by where they begin
  int hits = 0;
  for (std::uint32_t pixel = 0; pixel < stage.settings.camera.pixel_count(); pixel += 7) {
    std::vector<core::Corner> cells;
    dataflow::ChargedPicture picture(stage.database, stage.settings,
                                     [&](const core::Corner& cell, std::uint64_t) { cells.push_back(cell); });
    picture.render(pixel);
    const Path path(stage.settings.camera.primary_ray(pixel, 0), stage.settings.header.frame);
    CHECK(std::all_of(cells.begin(), cells.end(), [&](const core::Corner& cell) { return path.distance_to(cell) < 1.01; }));
    CHECK(std::is_sorted(cells.begin(), cells.end(),
                         [&](const core::Corner& a, const core::Corner& b) { return path.along(a) < path.along(b) - overlap; }));
    hits += picture.operations().shadings > 0 ? 1 : 0;
    CHECK((picture.operations().bvh_node_reads < 8 || cells.front() != cells.back()));
  }
  CHECK(hits > 50);
}

TEST_CASE("a view past the scene has no load and is still shared out") {
  core::Scene scene = mirrors_and_glass();
  scene.view.at = {scene.view.from.x, scene.view.from.y - 1, scene.view.from.z};
  const Stage stage(scene);
  CHECK(sum(stage.all_loads()) == 0);
  CHECK(balance(stage.database, stage.settings, 8, {}).regions.region_count() == 8);
}

TEST_CASE("a subsampled picture predicts the whole one's load far better than equal sizes do") {
  const Stage stage(built_in("rings-2-t1"), 128, 128);
  const ColumnLoads whole = stage.all_loads();
  for (const std::uint32_t count : {4U, 16U}) {
    const Balanced subsampled = balance(stage.database, stage.settings, count, {.subsample = 4});
    const Balanced equal = balance(stage.database, stage.settings, count, {.balance = Balance::equal_size});
    const double achieved = dataflow::average_load(loads_of_regions(*subsampled.regions.bsp(), whole));
    CHECK(achieved > 0.75);
    CHECK(achieved > 1.2 * dataflow::average_load(loads_of_regions(*equal.regions.bsp(), whole)));
    CHECK(subsampled.predicted.size() == count);
  }
}

TEST_CASE("a balance of one region is the whole grid") {
  const Stage stage(built_in("tetra-3"));
  const Balanced balanced = balance(stage.database, stage.settings, 1, {});
  CHECK(balanced.regions.region_at(0) == core::Region{{}, core::grid_size(stage.settings.header.frame)});
  CHECK(balanced.predicted.size() == 1);
}

TEST_CASE("a stop ends the subsampled picture, and the regions are there nevertheless") {
  const Stage stage(mirrors_and_glass());
  std::stop_source source;
  source.request_stop();
  const dataflow::ColumnLoads loads = dataflow::column_loads(stage.database, stage.settings, {}, source.get_token());
  CHECK(dataflow::share_out(loads, 5, {}).regions.region_count() == 5);
  CHECK(std::accumulate(loads.load.begin(), loads.load.end(), std::uint64_t{0}) == 0);
}

TEST_CASE("a balance with options out of range is wrong usage") {
  const Stage stage(built_in("tetra-3"));
  CHECK_THROWS_AS(balance(stage.database, stage.settings, 2, {.subsample = 0}), core::UsageError);
  CHECK_THROWS_AS(balance(stage.database, stage.settings, 0, {}), core::UsageError);
}

}  // namespace dmpc::tests::regions_balance_test

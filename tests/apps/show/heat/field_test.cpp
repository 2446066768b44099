#include "apps/show/heat/field.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "tests/apps/show/rendered.h"

namespace dmpc::apps::field_test {

using core::HeatKind;

namespace {

/// All kinds that the strategy has.
RenderOptions with_heat(RenderOptions options) {
  for (const HeatKind kind : {HeatKind::rays, HeatKind::time, HeatKind::node, HeatKind::depth, HeatKind::samples}) {
    options.heat_maps.push_back({kind, "a.exr"});
  }
  for (const HeatKind kind : {HeatKind::faults, HeatKind::references, HeatKind::pages}) {
    if (options.strategy == Strategy::svm) {
      options.heat_maps.push_back({kind, "a.exr"});
    }
  }
  return options;
}

/// The kinds of which another run gives the same bits.
std::vector<std::string> repeatable(const RenderOptions& options) {
  const Rendered rendered(with_heat(options));
  std::vector<std::string> names;
  for (const HeatRequest& request : rendered.options.heat_maps) {
    if (heat_field(request.kind, rendered.record()).is_repeatable) {
      names.emplace_back(core::name_of(request.kind));
    }
  }
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("the numbers of a heat map are the run's, with their meaning and unit") {
  const Rendered rendered(with_heat(small()));
  const HeatField rays = heat_field(HeatKind::rays, rendered.record());
  CHECK(rays.width == 16);
  CHECK(rays.height == 12);
  CHECK(rays.values.size() == 192);
  CHECK(rays.sum() == static_cast<double>(account_of(*rendered.report).operations.ray_count()));
  CHECK(rays.least() >= 1);
  CHECK(rays.largest() > rays.least());
  CHECK(rays.unit == "rays");
  CHECK(rays.clock.empty());
  const HeatField samples = heat_field(HeatKind::samples, rendered.record());
  CHECK(samples.least() == 1);
  CHECK(samples.largest() == 1);
}

TEST_CASE("the clock of times is named, and picoseconds become microseconds") {
  const Rendered on_threads(with_heat(small())), on_machine(with_heat(modelled()));
  CHECK(heat_field(HeatKind::time, on_threads.record()).clock == "processor time");
  const HeatField field = heat_field(HeatKind::time, on_machine.record());
  CHECK(field.clock == "virtual time");
  CHECK(field.sum() == doctest::Approx(static_cast<double>(on_machine.heat->sum(HeatKind::time)) / 1e6));
}

TEST_CASE("it is known which heat maps come out the same again") {
  CHECK(repeatable(small()) == Names{"rays", "depth", "samples", "references", "pages"});
  CHECK(repeatable(small(Strategy::replicated)) == Names{"rays", "depth", "samples"});
  CHECK(repeatable(small(Strategy::dataflow)) == Names{"rays", "node", "depth", "samples"});
  RenderOptions stays = small();
  stays.pages.work_item_side = 0;
  CHECK(repeatable(stays) == Names{"rays", "node", "depth", "samples", "references", "pages"});
  stays.pages.in_flight = 1;
  CHECK(repeatable(stays) == Names{"rays", "node", "depth", "samples", "faults", "references", "pages"});
  RenderOptions alone = small();
  alone.computer.node_count = 1;
  CHECK(repeatable(alone) == repeatable(stays));
  CHECK(repeatable(modelled()).size() == 8);
  CHECK(repeatable(modelled(Strategy::dataflow)).size() == 5);
}

TEST_CASE("a kind that was not recorded is not shown") {
  RenderOptions options = small();
  CHECK_THROWS_AS(heat_field(HeatKind::rays, Rendered(options).record()), core::InternalError);
  options.heat_maps = {{HeatKind::rays, "a.exr"}};
  CHECK_THROWS_AS(heat_field(HeatKind::faults, Rendered(options).record()), core::InternalError);
}

}  // namespace dmpc::apps::field_test

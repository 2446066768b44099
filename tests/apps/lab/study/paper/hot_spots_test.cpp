#include "apps/lab/study/paper/hot_spots.h"

#include <doctest/doctest.h>

#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/record/records.h"

namespace dmpc::tests::hot_spots_test {

using namespace apps;

namespace {

core::Corner cell_at(const core::GridFrame& frame, const core::Vec3f& position) {
  return cell_of_light({.frame = frame}, {.position = position});
}

}  // namespace

TEST_CASE("a light outside the grid lies in the nearest cell, one inside in its own") {
  const core::GridFrame frame{.resolution = {1, 2, 1}, .finest_cell = 0.5F};
  CHECK(cell_at(frame, {-1, -1, -1}) == core::Corner{0, 0, 0});
  CHECK(cell_at(frame, {1.4F, 40, 0}) == core::Corner{2, 80, 0});
  CHECK(cell_at(frame, {1e30F, 1e30F, 31.9F}) == core::Corner{63, 127, 63});
}

TEST_CASE("the flood at a light is what comes to its region over the mean, and nothing where nothing travels") {
  const PictureOptions picture{.scene = "tetra-3", .resolution = Resolution{24, 24}};
  const Subject subject = build_subject(load_scene(picture), picture);
  dataflow::Report report = dataflow::run_dataflow(subject.database, subject.settings, {.computer = {.node_count = 4}}, {});
  const core::DatabaseHeader& header = subject.database.header();
  const auto light = core::read<core::LightRecord>(core::LocalRecords(subject.database.bytes()).find(header.lights));
  const std::uint32_t owner = nodes::index_of(report.regions.owner_of(cell_of_light(header, light)));
  for (std::uint32_t node = 0; node < 4; ++node) {
    report.nodes[node].program.rays.in[static_cast<std::size_t>(core::RayKind::shadow)] = node == owner ? 300 : 100;
  }
  CHECK(shadow_flood(subject.database, report) == doctest::Approx(2));
  for (dataflow::NodeReport& node : report.nodes) {
    node.program.rays.in = {};
  }
  CHECK(shadow_flood(subject.database, report) == 0);
}

TEST_CASE("the flood of pages is that of the node that sends most") {
  svm::Report report{{{.film = core::Film(1, 1)}}};
  report.nodes.resize(2);
  CHECK(page_flood(report) == 0);
  report.nodes[1].counters.sent[svm::number_of(svm::Kind::page_reply)].packets = 3;
  report.nodes[0].counters.sent[svm::number_of(svm::Kind::page_reply)].packets = 1;
  CHECK(page_flood(report) == doctest::Approx(1.5));
}

}  // namespace dmpc::tests::hot_spots_test

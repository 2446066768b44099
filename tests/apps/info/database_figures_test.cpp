#include "apps/info/database_figures.h"

#include <doctest/doctest.h>

#include "apps/scene/load_scene.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/painted_square.h"

namespace dmpc::apps::database_figures_test {

namespace {

struct Found {
  explicit Found(const core::Scene& scene, const core::BuildOptions& options = {})
      : database(core::build_database(scene, options)), figures(figures_of(database, figures_of(scene))) {}

  const RecordFigures& records(const std::string& kind) const {
    for (const RecordFigures& record : figures.records) {
      if (record.kind == kind) {
        return record;
      }
    }
    throw core::InputError("there are no " + kind);
  }
  std::uint64_t record_bytes() const {
    std::uint64_t sum = 0;
    for (const RecordFigures& record : figures.records) {
      sum += record.bytes;
    }
    return sum;
  }

  core::Database database;
  DatabaseFigures figures;
};

}  // namespace

TEST_CASE("a database of nothing is a page with a directory") {
  const Found found{core::Scene{}};
  CHECK(found.figures.pages == 1);
  CHECK(found.figures.primitives == 0);
  CHECK(found.figures.levels_max == 0);
  CHECK(found.figures.occupied_macro_cells == 0);
  CHECK(found.figures.bytes_each() == 0);
  CHECK(found.figures.copies_each() == 0);
  CHECK(found.figures.primitives_a_leaf() == 0);
  CHECK(found.record_bytes() + found.figures.unused_bytes == 1024);
}

TEST_CASE("trees are looked through: what is counted is what the builder counted") {
  const Found found(load_scene("rings-2"));
  const core::RecordCounts& counts = found.database.records();
  CHECK(found.records("bvh_nodes").count == counts.bvh_nodes);
  CHECK(found.records("leaves of triangles").count == counts.leaves[0]);
  CHECK(found.records("leaves of spheres").count == counts.leaves[1]);
  CHECK(found.records("leaves of cones").count == counts.leaves[2]);
  CHECK(found.records("leaves of cones").count > 0);
  CHECK(found.figures.levels_max >= 1);
  CHECK(found.figures.levels_max <= core::bvh_levels_max);
  CHECK(found.figures.occupied_macro_cells >= 1);
  CHECK(found.figures.copies >= found.figures.primitives);
  CHECK(found.figures.primitives_a_leaf() > 1);
  CHECK(found.figures.primitives_a_leaf() <= 8);
}

TEST_CASE("of voxels the lists are looked through: each leaf is counted once, and no byte is missing") {
  const Found found(load_scene("rings-2"), {.structure = core::Structure::voxels});
  const core::RecordCounts& counts = found.database.records();
  CHECK(found.records("references of voxels").count == counts.voxel_references);
  CHECK(found.figures.references == counts.voxel_references);
  CHECK(found.records("leaves of triangles").count == counts.leaves[0]);
  CHECK(found.records("leaves of spheres").count == counts.leaves[1]);
  CHECK(found.records("leaves of cones").count == counts.leaves[2]);
  CHECK(found.records("bvh_nodes").count == 0);
  CHECK(found.figures.levels_max == 0);
  CHECK(found.figures.copies == found.figures.primitives);
  CHECK(found.record_bytes() + found.figures.unused_bytes == found.figures.bytes);
  CHECK(found.figures.unused_bytes < found.figures.bytes / 4);
}

TEST_CASE("of meshes that are kept trees are looked through once, and places are counted") {
  const Found found(tests::with_obstacles(core::Copies::put), tests::with_instances());
  const core::RecordCounts& counts = found.database.records();
  REQUIRE(counts.instances == 12);
  CHECK(found.figures.instances == 12);
  CHECK(found.records("places of meshes").count == 12);
  CHECK(found.records("places of meshes").bytes == 12 * 128);
  CHECK(found.records("leaves of places").count == counts.instance_leaves);
  CHECK(found.records("leaves of triangles").count == counts.leaves[0]);
  CHECK(found.records("bvh_nodes").count == counts.bvh_nodes);
  CHECK(found.figures.copies == found.database.references() - 12 + counts.base_mesh_triangles);
  CHECK(found.record_bytes() + found.figures.unused_bytes == found.figures.bytes);
  CHECK(found.figures.unused_bytes < found.figures.bytes / 3);
}

TEST_CASE("records and what lies between them make up the pages") {
  const tests::TemporaryFolder folder;
  for (const std::string& scene : {std::string("balls-2"), tests::write_painted_square(folder, 64).string()}) {
    CAPTURE(scene);
    const Found found(load_scene(PictureOptions{.scene = scene}, {}));
    CHECK(found.figures.bytes == found.database.bytes().size());
    CHECK(found.record_bytes() + found.figures.unused_bytes == found.figures.bytes);
    CHECK(found.figures.unused_bytes < found.figures.bytes);
  }
}

TEST_CASE("tiles of textures are those that the database has") {
  const tests::TemporaryFolder folder;
  const core::Scene scene = load_scene(PictureOptions{.scene = tests::write_painted_square(folder, 64)}, {});
  const Found found(scene);
  CHECK(found.records("texture tiles").count == figures_of(scene).textures[0].tiles);
  CHECK(found.records("entries of tables of tiles").bytes == figures_of(scene).textures[0].table_bytes);
  CHECK(found.records("textured triangles").count == 2);
}

TEST_CASE("what is degenerate is told apart from primitives") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  builder.sphere({0, 0, 0}, 0);
  const Found found(scene);
  CHECK(found.figures.primitives == 1);
  CHECK(found.figures.dropped == 1);
}

TEST_CASE("triangles that are there twice are counted") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}});
  builder.polygon({{1, 0, 0}, {0, 0, 0}, {0, 1, 1}});
  const Found found(scene);
  CHECK(found.figures.primitives == 1);
  CHECK(found.figures.duplicates == 1);
}

}  // namespace dmpc::apps::database_figures_test

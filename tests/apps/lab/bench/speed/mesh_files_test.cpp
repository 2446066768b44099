// Mesh files that `bench speed` has read.
#include "apps/lab/bench/speed/mesh_files.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/edge/system/output_file.h"
#include "apps/formats/mesh_file.h"
#include "apps/lab/bench/speed/assimp_rival.h"
#include "apps/lab/bench/speed/parts.h"
#include "core/base/expect.h"
#include "tests/support/small_subject.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::mesh_files_test {

using apps::Comparison;

TEST_CASE("a scene's triangles share their vertices in a mesh") {
  const apps::SharedMesh mesh = apps::mesh_of(small_subject("tetra-2", {8, 8}).database);  // 4 tetrahedra, each beside 3
  CHECK(mesh.triangles.size() == 4 * 4);
  CHECK(mesh.vertices.size() == 10);
}

TEST_CASE("we and Assimp read all triangles of a scene from a PLY and a GLB file") {
  const TemporaryFolder folder;
  const apps::SharedMesh mesh = apps::mesh_of(small_subject("teapot-3", {8, 8}).database);
  apps::write_file(folder / "mesh.ply", apps::ply_of(mesh));
  apps::write_file(folder / "mesh.glb", apps::glb_of(mesh));
  for (const char* name : {"mesh.ply", "mesh.glb"}) {
    CAPTURE(std::string(name));
    CHECK(apps::read_mesh_file((folder / name).string()).scene.objects.size() == mesh.triangles.size());
    CHECK(apps::read_by_assimp(folder / name) == mesh.triangles.size());
  }
}

TEST_CASE("what Assimp cannot read is an error with its words") {
  const TemporaryFolder folder;
  apps::write_file(folder / "mesh.ply", "no mesh at all");
  CHECK_THROWS_AS(apps::read_by_assimp(folder / "mesh.ply"), core::InputError);
}

TEST_CASE("part load holds our reading of each format against Assimp's in every round") {
  apps::SpeedSettings settings;
  settings.scenes = {"tetra-2", "balls-1"};  // of which the latter has no triangle but two of the ground
  settings.rounds = 2;
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_load(settings, interrupt, results);
  REQUIRE(results.size() == 4);
  CHECK(results[0].what == "load ply");
  CHECK(results[1].what == "load glb");
  for (const Comparison& one : results) {
    CHECK(one.rounds() == 2);
    CHECK(one.is_by_wall_clock());
  }
}

}  // namespace dmpc::tests::mesh_files_test

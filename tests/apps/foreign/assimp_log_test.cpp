#include "apps/foreign/assimp_log.h"

#include <doctest/doctest.h>

#include <assimp/DefaultLogger.hpp>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::assimp_log_test {

namespace {

/// A mesh of FBX whose second face ends with this index.
std::string fbx_mesh(int number, int last) {
  const std::string id = std::to_string(number);
  return "Geometry: 10" + id +
         ", \"Geometry::\", \"Mesh\" {\n Vertices: *9 {\n a: 0,0,0,2,0,0,0,1,0\n }\n PolygonVertexIndex: *3 {\n a: 0,1," +
         std::to_string(-last - 1) + "\n }\n}\nModel: 20" + id + ", \"Model::a\", \"Mesh\" {\n Version: 232\n}\n";
}

std::string fbx(const std::string& objects, const std::string& links) {
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\nObjects:  {\n" +
         objects + "}\nConnections:  {\n" + links + "}\n";
}

bool says(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("what Assimp warns of is said once a kind, with its count, and the kinds are few") {
  std::vector<std::string> notes;
  {
    const apps::AssimpLog log;
    ASSIMP_LOG_WARN("LWO: point 3 of \"a\" is lost.");
    ASSIMP_LOG_ERROR("LWO: point 14 of \"b\" is lost.");
    ASSIMP_LOG_INFO("nothing");
    for (char letter = 'a'; letter < 'k'; ++letter) {
      ASSIMP_LOG_WARN(std::string(1, letter));
    }
    log.note(notes);
  }
  ASSIMP_LOG_WARN("nobody hears that");
  CHECK(notes.size() == 9);
  CHECK(notes.front() == "Assimp says: LWO: point 3 of \"a\" is lost: 2");
  CHECK(notes.back() == "more that Assimp says: 3");
}

TEST_CASE("a mesh of FBX that Assimp leaves out for its bad index is said, or the reason why there is no mesh") {
  const TemporaryFolder folder;
  write_text(folder / "a.fbx", fbx(fbx_mesh(1, 2) + fbx_mesh(2, 7),
                                   " C: \"OO\",201,0\n C: \"OO\",101,201\n C: \"OO\",202,0\n C: \"OO\",102,202\n"));
  const apps::MeshFile file = apps::read_mesh_file(folder / "a.fbx");
  CHECK(file.scene.objects.size() == 1);
  CHECK(says(file.notes, "polygon vertex index out of range"));
  write_text(folder / "b.fbx", fbx(fbx_mesh(2, 7), " C: \"OO\",202,0\n C: \"OO\",102,202\n"));
  CHECK_THROWS_WITH_AS(apps::read_mesh_file(folder / "b.fbx"), doctest::Contains("polygon vertex index out of range"),
                       core::InputError);
}

TEST_CASE("formats of which wrong pictures would come without a word are refused, with what to do") {
  for (const std::string name : {"a.x3d", "b.3MF"}) {
    CHECK(apps::is_mesh_path(name));
    CHECK_THROWS_WITH_AS(apps::read_mesh_file(name), doctest::Contains("convert the file to glTF, OBJ, PLY, STL or OFF"),
                         core::InputError);
  }
}

}  // namespace dmpc::tests::assimp_log_test

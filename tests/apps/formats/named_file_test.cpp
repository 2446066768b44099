#include "apps/formats/named_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::named_file_test {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

namespace {

/// The file that is meant most likely, as seen from the folder; empty if there is none.
std::string meant(const TemporaryFolder& folder, const std::string& name) {
  const auto files = files_meant(folder.path(), name);
  return files.empty() ? "" : files.front().lexically_relative(folder.path()).generic_string();
}

}  // namespace

TEST_CASE("a file is found by its name before all others") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "textures");
  for (const char* name : {"wood.png", "Wood.png", "a b.png", "a%20b.png", "textures/wood.png"}) {
    tests::write_text(folder / name, "");
  }
  CHECK(meant(folder, "wood.png") == "wood.png");
  CHECK(meant(folder, "Wood.png") == "Wood.png");
  CHECK(meant(folder, "a%20b.png") == "a%20b.png");
  CHECK(meant(folder, "textures/wood.png") == "textures/wood.png");
  CHECK_FALSE(is_under_other_name(folder.path(), "wood.png", folder / "wood.png"));
}

TEST_CASE("a file is found in other letters' case, by a Windows path, and by its last part beside the mesh or in textures") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "Maps");
  fs::create_directories(folder / "Textures");
  for (const char* name : {"Maps/Wood.PNG", "stone.jpg", "Textures/grass.png", "a b.png"}) {
    tests::write_text(folder / name, "");
  }
  CHECK(meant(folder, "maps/wood.png") == "Maps/Wood.PNG");
  CHECK(meant(folder, "maps\\wood.png") == "Maps/Wood.PNG");
  CHECK(meant(folder, "C:\\art\\Stone.jpg") == "stone.jpg");
  CHECK(meant(folder, "../elsewhere/stone.JPG") == "stone.jpg");
  CHECK(meant(folder, "/home/somebody/grass.png") == "Textures/grass.png");
  CHECK(meant(folder, "a%20b.png") == "a b.png");
  CHECK_FALSE(is_under_other_name(folder.path(), "a%20b.png", folder / "a b.png"));
  CHECK_FALSE(is_under_other_name(folder.path(), ".\\Maps\\Wood.PNG", folder / "Maps/Wood.PNG"));
  CHECK(is_under_other_name(folder.path(), "maps/wood.png", folder / "Maps/Wood.PNG"));
}

TEST_CASE("only files are found, and none where there is none") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "wood.png");
  for (const char* name :
       {"wood.png", "none.png", "", ".", "..", "/", "\\", "C:", "textures", "/dev/zero", "http://127.0.0.1/a.png"}) {
    CAPTURE(name);
    CHECK(meant(folder, name) == "");
  }
}

TEST_CASE("one line says which textures were found under other names") {
  const TemporaryFolder folder;
  apps::write_image(folder / "Wood.png", Image(2, 2));
  tests::write_text(folder / "a.mtl", "newmtl paint\nmap_Kd C:\\art\\wood.png\n");
  tests::write_text(folder / "a.obj", "mtllib a.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  const MeshFile file = read_mesh_file(folder / "a.obj");
  CHECK(file.scene.textures.size() == 1);
  CHECK(std::count(file.notes.begin(), file.notes.end(),
                   "1 texture was found under other names: Wood.png for C:\\art\\wood.png") == 1);
}

}  // namespace dmpc::apps::named_file_test

#include "apps/formats/other_formats.h"

#include <doctest/doctest.h>

#include "apps/formats/mesh_file.h"
#include "tests/support/complaint.h"
#include "tests/support/text.h"

namespace dmpc::apps::other_formats_test {

namespace {

using tests::contains;

std::string complaint(const std::string& path) {
  return tests::complaint_of([&] { read_mesh_file(path); });
}

}  // namespace

TEST_CASE("a file of another format is refused with the line that converts it") {
  CHECK(complaint("models/Chair.LWO") ==
        "models/Chair.LWO: LWO is not read: have Assimp (Debian's assimp-utils) make glTF of it, and look at the result:\n"
        "  assimp export 'models/Chair.LWO' 'models/Chair.glb'");
  CHECK(complaint("a.step").ends_with("make STL of it, and look at the result:\n  gmsh 'a.step' -2 -o 'a.stl'"));
}

TEST_CASE("FBX, Collada and Blender's own are converted by Blender, whatever their files are called") {
  CHECK(contains(complaint("it's IMPORT OUT IN.fbx"), "bpy.ops.import_scene.fbx(filepath=sys.argv[-2]); "));
  CHECK(complaint("it's IMPORT OUT IN.fbx")
            .ends_with("export_lights=True)\" -- 'it'\\''s IMPORT OUT IN.fbx' 'it'\\''s IMPORT OUT IN.glb'"));
  CHECK(contains(complaint("a.dae"), "\n  blender --background --factory-startup --python-expr \"import bpy, sys; "));
  CHECK(contains(complaint("a.dae"), "bpy.ops.wm.collada_import(filepath="));
  CHECK(contains(complaint("IMPORT.blend"), "\n  blender --background --factory-startup 'IMPORT.blend' --python-expr"));
}

TEST_CASE("files of other formats are mesh files by their ending, and those of ours are none of others") {
  for (const char* const path : {"a.3mf", "a.X3D", "a.usdz", "a.Fbx", "b/a.ac"}) {
    CAPTURE(path);
    CHECK(is_other_format(path));
    CHECK(is_mesh_path(path));
  }
  for (const std::string& ending : mesh_extensions()) {
    CHECK_FALSE(is_other_format("a." + ending));
  }
  CHECK_FALSE(is_other_format("fbx"));
}

}  // namespace dmpc::apps::other_formats_test

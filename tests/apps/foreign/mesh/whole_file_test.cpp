// Files of other formats than glTF that are cut short, hold together badly or hold no mesh.

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "apps/formats/mesh_file.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::whole_file_test {

namespace {

std::string refusal_of(const std::string& name, const std::string& text) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / name, text);
  try {
    read_mesh_file(folder / name);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("text of PLY, STL, OFF and OBJ may begin with a byte order mark") {
  const std::string mark = "\xef\xbb\xbf";
  for (const auto& [name, text] : {std::pair{"a.ply", tests::triangle_ply},
                                   {"a.stl", tests::triangle_stl},
                                   {"a.obj", tests::triangle_obj},
                                   {"a.off", "OFF 3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n"}}) {
    CAPTURE(name);
    CHECK(refusal_of(name, text) == "");
    CHECK(refusal_of(name, mark + text) == "");
  }
}

}  // namespace dmpc::apps::whole_file_test

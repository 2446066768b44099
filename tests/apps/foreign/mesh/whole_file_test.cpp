// Files of other formats than glTF that are cut short, hold together badly or hold no mesh.

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"

namespace dmpc::apps::whole_file_test {

TEST_CASE("text of PLY, STL, OFF and OBJ may begin with a byte order mark") {
  const std::string mark = "\xef\xbb\xbf";
  for (const auto& [name, text] : {std::pair{"a.ply", tests::triangle_ply},
                                   {"a.stl", tests::triangle_stl},
                                   {"a.obj", tests::triangle_obj},
                                   {"a.off", "OFF 3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n"}}) {
    CAPTURE(name);
    CHECK(tests::mesh_refusal(name, text) == "");
    CHECK(tests::mesh_refusal(name, mark + text) == "");
  }
}

}  // namespace dmpc::apps::whole_file_test

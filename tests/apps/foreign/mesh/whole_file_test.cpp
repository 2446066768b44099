// Files of other formats than glTF that are cut short, hold together badly or hold no mesh.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/foreign/mesh/obj_check.h"
#include "apps/foreign/mesh/ply_check.h"
#include "apps/foreign/mesh/stl_check.h"
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

std::string binary_ply(const std::string& format, const std::string& body) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 1\nproperty uchar x\nelement face 1\nproperty list ushort int i\nend_header\n" + body;
}

}  // namespace

TEST_CASE("a PLY file cut within its header is refused at once, wherever it is cut") {
  const std::string header = tests::triangle_ply.substr(0, tests::triangle_ply.find("end_header") + 10);
  for (std::size_t length = 0; length <= header.size(); ++length) {
    CHECK_THROWS_AS(check_ply(header.substr(0, length)), core::InputError);
  }
  CHECK(tests::contains(refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nprop"),
                        "a.ply: line 4: the file ends within its header"));
  CHECK(tests::contains(refusal_of("a.ply", "ply\nelement vertex three\n"), "line 2: expected 'element NAME COUNT'"));
  CHECK(
      tests::contains(refusal_of("a.ply", "ply\nelement vertex 3\nproperty real x\n"), "line 3: expected 'property TYPE NAME'"));
  check_ply("ply\nformat ascii 1.0\nCreated by somebody\ncomment b\nobj_info c\nend_header\n");
}

TEST_CASE("a PLY file cut within its body is refused with what it ends in") {
  const std::string whole = tests::triangle_ply;
  check_ply(whole);
  CHECK(tests::contains(refusal_of("a.ply", whole.substr(0, whole.find("3 0 1 2") + 5)), "it ends within element 'face' 1 of 1"));
  CHECK(tests::contains(refusal_of("a.ply", whole.substr(0, whole.find("0 1 0"))), "it ends within element 'vertex' 3 of 3"));
  check_ply(binary_ply("binary_little_endian", std::string("x\1\0abcd", 7)));
  check_ply(binary_ply("binary_big_endian", std::string("x\0\1abcd", 7)));
  CHECK_THROWS_AS(check_ply(binary_ply("binary_big_endian", std::string("x\1\0abcd", 7))), core::InputError);
  CHECK_THROWS_AS(check_ply(binary_ply("binary_little_endian", std::string("x\1\0abc", 6))), core::InputError);
  CHECK_THROWS_AS(check_ply(binary_ply("binary_little_endian", "x")), core::InputError);
}

TEST_CASE("an STL file cut short is refused, in text and in binary") {
  check_stl(tests::triangle_stl);
  check_stl(tests::triangle_binary_stl());
  const std::string& text = tests::triangle_stl;
  for (const char* word : {"endloop", "endfacet", "endsolid"}) {
    CHECK(tests::contains(refusal_of("a.stl", text.substr(0, text.find(word))), "cut short"));
  }
  const std::string binary = tests::triangle_binary_stl();
  CHECK(tests::contains(refusal_of("a.stl", binary.substr(0, 120)), "it has room for 0 facets, and says that it has 1"));
  CHECK(tests::contains(refusal_of("a.stl", binary.substr(0, 50)), "is no STL"));
}

TEST_CASE("text of PLY, STL, OBJ and MTL may begin with a byte order mark") {
  const std::string mark = "\xef\xbb\xbf";
  for (const auto& [name, text] :
       {std::pair{"a.ply", tests::triangle_ply}, {"a.stl", tests::triangle_stl}, {"a.obj", tests::triangle_obj}}) {
    CAPTURE(name);
    CHECK(refusal_of(name, text) == "");
    CHECK(refusal_of(name, mark + text) == "");
  }
}

TEST_CASE("an OBJ file with an index of nothing is refused, be it of a vertex, a place or a normal") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  CHECK(refusal_of("a.obj", vertices + "f 1/1/1 2/1/1 3/1/1\n").empty());
  const auto refusal = [&](const std::string& face) { return refusal_of("a.obj", vertices + face); };
  CHECK(tests::contains(refusal("f 1/1/1 2/1/1 4/1/1\n"), "line 6: the face has vertex 4, which does not exist: there are 3"));
  CHECK(tests::contains(refusal("f 1/1/1 2/2/1 3/1/1\n"), "texture coordinate 2, which does not exist: there are 1"));
  CHECK(tests::contains(refusal("f 1//1 2//1 \\\n3//2\n"), "line 7: the face has normal 2, which does not exist: there are 1"));
  CHECK(tests::contains(refusal("f 1 2 -4\n"), "vertex -4, which does not exist: there are 3 before it"));
  CHECK_FALSE(refusal("f 1 2 0\n").empty());
  check_obj(vertices + "f -3/-1/-1 -2/-1/-1 -1/-1/-1 # 9\nf 1 2 4\nv 0 0 1\n");
}

TEST_CASE("a Collada file without a mesh is refused, and no figure is shown in its place") {
  const std::string refusal =
      refusal_of("a.dae",
                 "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
                 "version=\"1.4.1\"><library_visual_scenes>"
                 "<visual_scene id=\"s\"><node id=\"a\"><translate>0 0 1</translate><node id=\"b\"><translate>0 1 "
                 "0</translate></node></node>"
                 "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
  CHECK(tests::contains(refusal, "there is no mesh in it"));
}

}  // namespace dmpc::apps::whole_file_test

// The statements of OBJ files.

#include "apps/foreign/obj/parser.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/srgb.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"
#include "tests/support/text.h"

namespace dmpc::apps::obj::parser_test {

using core::Vec3d;
using Indices = std::vector<std::uint32_t>;

namespace {

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", named = three + "vt 0 0\nvn 0 0 1\n";

Geometry parse(const std::string& text) {
  SceneTotals unbounded;
  return parse_obj(
      text, [](float) {}, unbounded);
}

std::string refusal(const std::string& text) {
  return tests::complaint_of([&] { parse(text); });
}

bool notes(const std::string& text, const std::string& note) {
  const std::vector<std::string> all = parse(text).notes;
  return std::find(all.begin(), all.end(), note) != all.end();
}

}  // namespace

TEST_CASE("what is wrong in a statement is refused, with its line, and what is not is taken") {
  for (const auto& row : tests::rows_in("apps/foreign/obj/refusals.txt", 2)) {
    CAPTURE(row[0]);
    CHECK(refusal(row[0]) == row[1]);
  }
}

TEST_CASE("a vertex has three coordinates as doubles, a weight by which they are divided, or a colour") {
  CHECK(parse("v 5412345.25 .5 1e-3").vertices == std::vector<Vec3d>{{5412345.25, 0.5, 1e-3}});
  CHECK(parse("v 2 4 6 2").vertices == std::vector<Vec3d>{{1, 2, 3}});
  CHECK(parse("v 2 4 6 1").colors.empty());
  const Geometry colored = parse("v 0 0 0\nv 1 2 3 0.5 0.25 1\nv 0 0 0");
  CHECK(colored.colors ==
        std::vector<Vec3d>{{1, 1, 1}, {core::linear_from_srgb(0.5), core::linear_from_srgb(0.25), 1}, {1, 1, 1}});
  CHECK(notes("v 0 0 0 255 0 -1", "vertices whose colour lies outside 0 to 1, brought into it: 1"));
  CHECK(notes("v 0 0 0\nv 0 0 0 1 0 0\nv 0 0 0\n", "vertices without a colour beside others that have one, shown white: 2"));
}

TEST_CASE("a place has one to three coordinates, of which two are kept, a normal three") {
  CHECK(parse("vt 1\nvt 1 2\nvt 1 2 3").places == std::vector<std::array<double, 2>>{{1, 0}, {1, 2}, {1, 2}});
  CHECK(parse("vn 0 0 2").normals == std::vector<Vec3d>{{0, 0, 2}});
}

TEST_CASE("corners name vertices, places and normals, from 1 on or backwards, faces in different forms beside one another") {
  const Faces faces = parse(named + "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//-1 3//1\nf -3/-1/-1 -2/1/1 -1/1/1\nf 1/ 2/ 3//\n").faces;
  CHECK(faces.ends == Indices{3, 6, 9, 12, 15});
  CHECK(faces.corners == Indices{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2});
  CHECK(faces.places == Indices{none, none, none, 0, 0, 0, none, none, none, 0, 0, 0, none, none, none});
  CHECK(faces.normals == Indices{none, none, none, none, none, none, 0, 0, 0, 0, 0, 0, none, none, none});
  CHECK(parse(three + "fo 1 2 3").faces.ends == Indices{3});
  CHECK(parse(three + "f 1 \\\n 2 \\\r\n 3 # the last").faces.ends == Indices{3});
}

TEST_CASE("a corner that is none is refused with its line") {
  for (const std::string corner : {"x", "1x", "1/x", "/1", "1/1/1/1", "1/1/1/", "1.5", "1//x", "99999999999999999999"}) {
    CAPTURE(corner);
    CHECK(refusal(named + "f 1 2 " + corner).ends_with("', expected a corner such as 3, 3/1, 3//2 or 3/1/2"));
  }
}

TEST_CASE("what a corner names may stand behind it, and what does not exist is refused with the face's line") {
  CHECK(parse("f 1 2 3\n" + three).faces.corners == Indices{0, 1, 2});
  CHECK(refusal(named + "f 1//1 2//1 \\\n3//2") == "line 7: the face has normal 2, which does not exist: there are 1");
  CHECK(parse(three + "f 1 2 4\nv 0 0 1").faces.corners == Indices{0, 1, 3});
}

TEST_CASE("a face has up to 65,535 corners") {
  const std::string face = three + "f" + tests::repeated(65'535, " 1");
  CHECK(parse(face).faces.ends == Indices{65'535});
  CHECK(refusal(face + " 1") == "line 4: the face has too many corners, more than 65,535; divide it");
}

TEST_CASE("a material holds from its name on, and a smoothing group from its number on") {
  const Geometry geometry =
      parse(three + "f 1 2 3\nusemtl a b\nusemtl c\ns 2\nf 1 2 3\nusemtl a b\nf 1 2 3\nusemtl a b\ns off\nf 1 2 3\n");
  CHECK(geometry.material_names == std::vector<std::string>{"a b", "c"});
  REQUIRE(geometry.runs.size() == 3);
  CHECK(geometry.runs[0].name == none);
  CHECK(geometry.runs[1].name == 1);
  CHECK(geometry.runs[2].name == 0);
  CHECK(geometry.runs[2].first_face == 2);
  CHECK(geometry.faces.groups == Indices{0, 2, 2, 0});
  CHECK(parse(three + "s 0\nf 1 2 3\n").faces.groups.empty());
  CHECK(parse(three + "s on\nf 1 2 3\ns OFF\nf 1 2 3\ns -2147483648\nf 1 2 3\ns\nf 1 2 3\n").faces.groups ==
        Indices{1, 0, 0x80000000U, 0});
}

TEST_CASE("files of materials are kept as they are named, once each, and not too many") {
  CHECK(parse("mtllib a b.mtl \nmtllib c.mtl\nmtllib a b.mtl").libraries == std::vector<std::string>{"a b.mtl", "c.mtl"});
  std::string many;
  for (int i = 0; i < 200'000; ++i) {
    many += "mtllib " + std::to_string(i) + ".mtl\n";
  }
  CHECK(refusal(many) == "line 1001: more than 1,000 files of materials are named; join them");
}

TEST_CASE("what is not shown is counted by kinds, and nothing is carried out") {
  const std::string rest =
      "p 1\nl 1 2\nf 1 2\nf\nvp 0 1\ncstype bezier\ndeg 3\nsurf 0 1 0 1 1 2 3\ncurv 0 1 1 2\nend\nlod 1\nmg 1 0.5\n"
      "usemap a\nmaplib b\nshadow_obj c\ntrace_obj d\ncall e\ncsh touch f\no g\ng h i\n# v\n";
  for (const char* note :
       {"points and lines left out: 3", "faces without a corner left out: 1",
        "statements about free-form curves and surfaces left out: 4", "free-form surfaces left out: 1",
        "free-form curves left out: 1", "levels of detail not followed: 1", "merging groups not followed: 1",
        "statements usemap, whose textures are not shown: 1", "statements maplib, whose textures are not shown: 1",
        "statements shadow_obj, whose files are not read: 1", "statements trace_obj, whose files are not read: 1",
        "statements call, which are not carried out: 1", "statements csh, which are not carried out: 1"}) {
    CAPTURE(note);
    CHECK(notes(three + rest, note));
  }
  CHECK(parse(three + "o g\ng h i\n# v\nf 1 2 3\n").notes.empty());
  CHECK(notes("foo 1", "unknown statements left out: 1, 'foo' in line 1"));
  CHECK(notes("\nfoo 1\nbar", "unknown statements left out: 2, the first 'foo' in line 2"));
}

TEST_CASE("much of what is small or long is read in one go") {
  const std::string groups = three + tests::repeated(1'000'000, "g a\ns 1\n");
  CHECK(parse(groups + "f 1 2 3").faces.groups == Indices{1});
  CHECK(parse(three + "# " + std::string(std::size_t{1} << 24U, 'x') + "\nf 1 2 3").faces.ends == Indices{3});
  CHECK(parse("").faces.ends.empty());
}

TEST_CASE("how much has passed is heard, up to all") {
  float last = 0;
  SceneTotals unbounded;
  parse_obj(
      three,
      [&last](float share) {
        CHECK(share > last);
        last = share;
      },
      unbounded);
  CHECK(last == 1);
}

}  // namespace dmpc::apps::obj::parser_test

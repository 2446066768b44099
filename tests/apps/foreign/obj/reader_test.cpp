// OBJ files as scenes, with their materials.

#include "apps/foreign/obj/reader.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "tests/support/complaint.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::obj_reader_test {

using core::ObjectKind;
using core::Scene;
using core::Vec3d;

namespace {

const Vec3d grey{0.6, 0.6, 0.6}, red{1, 0, 0}, blue{0, 0, 1};
const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", face = "f 1 2 3 4\n";
const std::string red_and_blue = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";

/// a.obj, beside it a.mtl, other files by name, and wood.png.
MeshFile read(const std::string& obj, const std::string& mtl = "", const std::map<std::string, std::string>& others = {},
              const MeshOptions& options = {}) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj", obj);
  tests::write_text(folder / "a.mtl", mtl);
  for (const auto& [name, text] : others) {
    tests::write_text(folder / name, text);
  }
  write_image(folder / "wood.png", Image(4, 2));
  write_image(folder / "wood #1.png", Image(4, 2));
  return read_mesh_file(folder / "a.obj", options);
}

std::string refusal(const std::string& obj, const std::string& mtl = "") {
  return tests::complaint_of([&] { read(obj, mtl); });
}

Vec3d color_of(const MeshFile& file, std::size_t object = 0) {
  return file.scene.materials[file.scene.objects.at(object).material].color;
}

bool notes(const MeshFile& file, const std::string& note) {
  return std::find(file.notes.begin(), file.notes.end(), note) != file.notes.end();
}

}  // namespace

TEST_CASE("what names no colour is white below colours of vertices, which are a screen's") {
  const std::string colored = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n";
  CHECK(color_of(read(colored)) == Vec3d{1, 0, 0});
  CHECK(color_of(read("mtllib a.mtl\nusemtl dull\n" + colored, "newmtl dull\nNs 10\n")) == Vec3d{1, 0, 0});
  CHECK(color_of(read("mtllib a.mtl\nusemtl blue\n" + colored, "newmtl blue\nKd 0.5 0 1\n")) == Vec3d{0.5, 0, 0});
}

TEST_CASE("a surface that lets all light through is said, since nothing of it is seen") {
  const std::string text = "mtllib a.mtl\n" + square + "usemtl glass\n" + face;
  CHECK(notes(read(text, "newmtl glass\nd 0\n"), "meshes that let all light through, so that nothing of them is seen: 1"));
  const MeshFile veil = read(text, "newmtl glass\nd 0.1\n");
  CHECK(!notes(veil, "meshes that let all light through, so that nothing of them is seen: 1"));
}

TEST_CASE("faces before any usemtl are grey, whatever the files of materials hold") {
  const MeshFile file = read("mtllib a.mtl\n" + square + face + "usemtl red\n" + face, red_and_blue);
  CHECK(color_of(file, 0) == grey);
  CHECK(color_of(file, 1) == red);
}

TEST_CASE("a material may be named before its file is") {
  CHECK(color_of(read("usemtl red\n" + square + face + "mtllib a.mtl\n", red_and_blue)) == red);
}

TEST_CASE("a material that is in no file is grey, and said") {
  const MeshFile file = read("mtllib a.mtl\n" + square + "usemtl green\n" + face + "usemtl red\n" + face, red_and_blue);
  CHECK(color_of(file) == grey);
  CHECK(notes(file, "materials that are named and in no file of materials, shown grey: 'green'"));
  CHECK(
      notes(read(square + "usemtl green\n" + face), "materials that are named and in no file of materials, shown grey: 'green'"));
}

TEST_CASE("names may have blanks and what looks like a remark, and remarks behind them") {
  const std::string obj = "mtllib a.mtl\n" + square;
  const std::string paints = "newmtl paint #1\nKd 1 0 0\nnewmtl paint #2\nKd 0 0 1\n";
  CHECK(color_of(read(obj + "usemtl paint #1\n" + face, paints)) == red);
  CHECK(color_of(read(obj + "usemtl paint #2\n" + face, paints)) == blue);
  CHECK(color_of(read(obj + "usemtl paint\n" + face, "newmtl paint # red\nKd 1 0 0\n")) == red);
  CHECK(color_of(read(obj + "usemtl paint # red\n" + face, "newmtl paint\nKd 1 0 0 # red\n")) == red);
}

TEST_CASE("mtllib names a file whose name has blanks, or a list of files, of which the first that has a material counts") {
  const std::string two = "mtllib b.mtl a.mtl # two\n" + square + "usemtl red\n" + face;
  CHECK(color_of(read(two, red_and_blue, {{"b.mtl", "newmtl other\n"}})) == red);
  const MeshFile repeated = read(two, red_and_blue, {{"b.mtl", "newmtl red\nKd 0 0 1\n"}});
  CHECK(color_of(repeated) == blue);
  CHECK(notes(repeated, "materials that are there again, of which the first is shown: 1"));
  CHECK(color_of(read(two, "", {{"b.mtl a.mtl", red_and_blue}})) == red);
  CHECK(color_of(read("mtllib b #1.mtl\n" + square + "usemtl red\n" + face, "", {{"b #1.mtl", red_and_blue}})) == red);
  CHECK(color_of(read("mtllib a.mtl  \n" + square + "usemtl red\n" + face, red_and_blue)) == red);
}

TEST_CASE("files of materials that are missing are named, each of a list") {
  const std::string said = refusal("mtllib b.mtl c.mtl\n" + square + face);
  CHECK(tests::contains(said, "b.mtl is missing"));
  CHECK(tests::contains(said, "c.mtl is missing"));
}

TEST_CASE("an error in a file of materials has its name and line") {
  CHECK(tests::contains(refusal("mtllib a.mtl\n" + square + "usemtl red\n" + face, "newmtl red\nKd 1x 0 0\n"),
                        "a.obj: a.mtl: line 2: found '1x', expected a number"));
}

TEST_CASE("a file of materials is found in other letters' case, which is said") {
  const MeshFile file = read("mtllib Paint.MTL\n" + square + "usemtl red\n" + face, "", {{"paint.mtl", red_and_blue}});
  CHECK(color_of(file) == red);
  CHECK(notes(file, "a file of materials was found under another name: paint.mtl for Paint.MTL"));
}

TEST_CASE("faces of one smoothing group are smooth among themselves, those of others and of none are not") {
  const std::string roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\n", left = "f 1 2 3\n", right = "f 1 3 4\n";
  const auto kinds = [](const MeshFile& file) { return std::pair(file.scene.objects.at(0).kind, file.scene.objects.at(1).kind); };
  const std::pair smooth(ObjectKind::patch, ObjectKind::patch), flat(ObjectKind::polygon, ObjectKind::polygon);
  const MeshFile file = read(roof + "s 1\n" + left + right);
  CHECK(kinds(file) == smooth);
  CHECK(length(normalize(file.scene.normals.at(0)) - normalize(Vec3d{-1, 0, 1})) < 1e-12);
  CHECK(kinds(read(roof + "s 1\n" + left + "s 2\n" + right)) == flat);
  CHECK(kinds(read(roof + "s 1\ns off\n" + left + right)) == flat);
  CHECK(kinds(read(roof + left + right)) == flat);
  CHECK(kinds(read(roof + "s 1\n" + left + right, "", {}, {.smooth_degrees = 60})) == flat);
  CHECK(kinds(read(roof + "s 1\nusemtl a\n" + left + "usemtl b\n" + right)) == smooth);
}

TEST_CASE("normals of the file stand, beside faces that have none") {
  const Scene scene = read(square + "vn 0 0 1\nvn 0 1 0\ns 1\nf 1//1 2//2 3//1\n" + face).scene;
  CHECK(scene.objects.at(0).kind == ObjectKind::patch);
  CHECK(scene.normals.at(1) == Vec3d{0, 1, 0});
  CHECK(scene.objects.at(1).kind == ObjectKind::polygon);
}

TEST_CASE("a texture lies where corners have a place on it, and what has none is plain, which is said") {
  const std::string obj = "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 1 0.25\n" + square + "usemtl wood\n";
  const std::string placed = "f 1/1 2/2 3/3\n", wood = "newmtl wood\nKd 1 1 1\nmap_Kd wood.png # brown\n";
  const MeshFile file = read(obj + placed + face, wood);
  CHECK(file.scene.textures.size() == 1);
  CHECK(file.scene.objects.at(0).kind == ObjectKind::textured);
  CHECK(file.scene.corners.at(2).place == std::array<float, 2>{1, 0.75F});
  CHECK(file.scene.objects.at(1).kind == ObjectKind::polygon);
  CHECK(notes(file, "faces without a place on their texture, shown in their plain colour: 1"));
  const MeshFile plain = read(obj + face, wood);
  CHECK(plain.scene.textures.empty());
  CHECK(notes(plain, "textures not shown, since no corner has a place on it: 1"));
  CHECK(notes(read(obj + placed, "newmtl wood\nKd 0 0 0\nmap_Kd wood.png\n"),
              "materials that are black, so that nothing of their texture shows: 1"));
  CHECK(read(obj + placed, "newmtl wood\nmap_Kd wood #1.png\n").scene.textures.at(0).name.ends_with("wood #1.png"));
}

TEST_CASE("what of materials is not shown is said once a kind, of those alone that some face has") {
  const std::string paint =
      "newmtl red\nKd 2 0 0\nKe 1 1 1\nPc 1\nd 0.5\nTr 0.4\nTf 1 0 0\nKs xyz 1 1 1\nmap_Ks a.png\nbump b.png\n"
      "newmtl lamp\nKe 0.5 2 -1\nnewmtl screen\nKe 1 1 1\nmap_Ke c.png\n";
  const MeshFile file =
      read("mtllib a.mtl\n" + square + "usemtl red\n" + face + "usemtl lamp\n" + face + "usemtl screen\n" + face,
           paint + "newmtl other\nKe 1 1 1\n");
  for (const char* note :
       {"textures not used, since they are not of a surface's colour: 3",
        "materials that shine, which light other things by paths alone: 2",
        "materials whose own light is a texture's, shown without it: 1", "materials with a clear coat, shown without it: 1",
        "materials that colour what shines through them (Tf), shown without that: 1",
        "materials with colours by spectral curves or CIE XYZ, which are not followed: 1",
        "materials whose d and Tr contradict each other, shown by d: 1",
        "materials with colours outside 0 to 1, brought into it: 1"}) {
    CAPTURE(note);
    CHECK(notes(file, note));
  }
}

TEST_CASE("a Ks without an Ns, an illum of 0 and a halo are said, for each material that has one") {
  const MeshFile file = read("mtllib a.mtl\n" + square + "usemtl a\n" + face + "usemtl b\n" + face + "usemtl c\n" + face,
                             "newmtl a\nKs 1 1 1\nd -halo 0.5\nnewmtl b\nKs 1 1 1\nNs 9\nillum 0\nnewmtl c\nKs 1 1 1\nillum 1\n");
  CHECK(notes(file, "materials with a Ks and no Ns, shown without a highlight: 1"));
  CHECK(notes(file, "materials with an illum other than 1 to 9, shaded all the same: 1"));
  CHECK(notes(file, "materials with d -halo, as opaque at their edges as elsewhere: 1"));
}

TEST_CASE("a material's numbers that lie outside of what they may be are said, once a kind") {
  const MeshFile file = read("mtllib a.mtl\n" + square + "usemtl a\n" + face + "usemtl b\n" + face + "usemtl c\n" + face,
                             "newmtl a\nKd 1 0 0\nNs -5\nd 2\nNi 0\nnewmtl b\nNs 10001\nTr -1\nNi -1\nKe 1 -1 0\n"
                             "newmtl c\nPr 1.5\nPm 1\nNs 10000\nd 1\nTr 0\nNi 0.5\n");
  for (const char* note :
       {"materials with a d, Tr, Pr or Pm outside 0 to 1, brought into it: 3",
        "materials with an Ns outside 0 to 10,000, brought into it: 2", "materials with a Ke below 0, taken for 0: 1",
        "materials with an Ni of 0 or less, shown as if they had none: 2"}) {
    CAPTURE(note);
    CHECK(notes(file, note));
  }
}

TEST_CASE("names of files may stand in quotes") {
  const std::string wood = "newmtl w\nmap_Kd \"wood #1.png\"\n", obj = square + "vt 0 0\nusemtl w\nf 1/1 2/1 3/1\n";
  for (const std::string name : {"\"b.mtl\"", "\"my b.mtl\"", "\"a.mtl\" \"b.mtl\""}) {
    CAPTURE(name);
    const MeshFile file = read("mtllib " + name + "\n" + obj, "", {{"b.mtl", wood}, {"my b.mtl", wood}});
    CHECK(file.scene.textures.size() == 1);
  }
}

TEST_CASE("surveyed coordinates keep their digits") {
  const Scene scene = read("v 512345.5 5412345.25 0\nv 512345.75 5412345.25 0\nv 512345.5 5412345.5 0\nf 1 2 3\n").scene;
  CHECK(scene.vertices.at(1) - scene.vertices.at(0) == Vec3d{0.25, 0, 0});
  CHECK(scene.coordinate_rounding == 0);
}

TEST_CASE("faces stay in the file's order, whatever their materials") {
  const MeshFile file =
      read("mtllib a.mtl\n" + square + "usemtl red\nf 1 2 3\nusemtl blue\nf 4 3 2\nusemtl red\nf 1 3 4\n", red_and_blue);
  REQUIRE(file.scene.objects.size() == 3);
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  CHECK(file.scene.vertices == std::vector<Vec3d>{a, b, c, d, c, b, a, c, d});
  CHECK(color_of(file, 0) == red);
  CHECK(color_of(file, 1) == blue);
  CHECK(color_of(file, 2) == red);
}

TEST_CASE("a Tr of 1 alone on all materials is of what is opaque, as MeshLab and OpenMVS wrote it, and said") {
  const std::string opaque = "newmtl a\nKd 1 0 0\nTr 1.000000\n";
  const MeshFile file = read("mtllib a.mtl\n" + square + "usemtl a\n" + face, opaque);
  CHECK(file.scene.materials.at(0).transmittance == 0);
  CHECK(color_of(file) == red);
  CHECK(tests::notes(file, "materials with a Tr of 1 and no d, as all are, shown as opaque"));
  const auto transmittance_of_first = [&](const std::string& mtl, const std::string& more) {
    return read("mtllib a.mtl\n" + square + "usemtl a\n" + face + more, mtl).scene.materials.at(0).transmittance;
  };
  CHECK(transmittance_of_first(opaque + "d 0\n", "") == 1);
  CHECK(transmittance_of_first(opaque + "newmtl b\nTr 1\n", "usemtl b\n" + face) == 0);
  CHECK(transmittance_of_first(opaque + "newmtl b\nTr 0.5\n", "usemtl b\n" + face) == 1);
  CHECK(transmittance_of_first(opaque + "newmtl b\n", "") == 0);  // on no face
}

TEST_CASE("what is no number is left out and said where no face has it, and else refused with its line") {
  const std::string coloured = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\n";
  const MeshFile file = read(coloured + "v 1 2 0 nan nan nan\nv -nan(ind) 1.#QNAN inf\nvn nan 0 0\nvt nan 0\n" + face);
  CHECK(color_of(file) == red);
  CHECK(notes(file, "vertices of what is no number, left out as no face has them (the first in line 5): 2"));
  CHECK(notes(file, "normals of what is no number, left out as no face has them (the first in line 7): 1"));
  CHECK(notes(file, "texture coordinates of what is no number, left out as no face has them (the first in line 8): 1"));
  CHECK(tests::contains(refusal(coloured + "v 1 2 0 nan nan nan\nf 1 2 5\n"), "line 5: expected a number"));
  CHECK(tests::contains(refusal(square + "vn 0 0 nan\nf 1//1 2//1 3//1\n"), "line 5: expected a number"));
  CHECK(tests::contains(refusal(square + "v 1 2 0x\n" + face), "line 5: found '0x', expected a number"));
}

}  // namespace dmpc::apps::obj_reader_test

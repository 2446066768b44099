// Options of textures in MTL files.

#include "apps/foreign/mesh/mtl_text.h"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <utility>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "core/scene/scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::mtl_text_test {

namespace {

/// What Assimp gets of a line, and what is kept.
struct Plain {
  explicit Plain(const std::string& line) : text(plain_mtl("a.mtl", "newmtl a\n" + line, textures).text.substr(9)) {}

  MtlTextures textures;
  std::string text;
};

/// A square whose texture has these options before its name, and its corners' places, (0 1), (2 1), (2 0), (0 0) without any.
MeshFile square_with(const std::string& texture) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj",
                    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\nusemtl painted\n"
                    "f 1/1 2/2 3/3 4/4\n");
  tests::write_text(folder / "a.mtl", "newmtl other\nKd 1 0 0\nnewmtl painted\nKd 1 1 1\n" + texture + "\n");
  write_image(folder / "my wood.png", Image(4, 2));
  return read_mesh_file(folder / "a.obj");
}

}  // namespace

TEST_CASE("a texture keeps its name, whatever options stand before it") {
  using Case = std::pair<const char*, const char*>;
  for (const auto& [line, plain] :
       {Case{"map_Kd wood.png", "map_Kd wood.png"}, Case{"map_Kd -s 2 2 2 wood.png", "map_Kd wood.png"},
        Case{"map_Kd -s 2 wood.png", "map_Kd wood.png"}, Case{"map_Kd -o .5 1e1 -s 3 my wood.png\r", "map_Kd my wood.png\r"},
        Case{"\tmap_Kd -blendu off -clamp on wood.png", "map_Kd -clamp on wood.png"},
        Case{"map_Kd -clamp on -clamp off wood.png", "map_Kd wood.png"}, Case{"map_Kd -s 2 2 2", "map_Kd 2"},
        Case{"map_Kd -s", "map_Kd -s"}, Case{"map_Kd -wood.png", "map_Kd -wood.png"},
        Case{"map_Bump -bm 0.5 -imfchan r bumps.png", "map_Bump bumps.png"},
        Case{"refl -type sphere sky.png", "refl -type sphere sky.png"},
        Case{"# map_Kd -s 2 wood.png", "# map_Kd -s 2 wood.png"}}) {
    CHECK(Plain(line).text == plain);
  }
}

TEST_CASE("options that are not followed are counted, unless they change nothing or are of a texture that is not shown") {
  CHECK(Plain("map_Kd -mm 0 1 -t 0 0 0 -blendu on -cc off -boost 0 -s 2 2 -o 1 wood.png").textures.left_out.empty());
  CHECK(Plain("map_Ks -mm 0.5 1 wood.png").textures.left_out.empty());
  const MtlTextures textures = Plain("map_Kd -mm 0.5 -imfchan r a.png\nmap_Kd -MM 0 2 -blendv off b.png").textures;
  CHECK(textures.left_out == std::map<std::string, std::uint64_t>{{"-mm", 2}, {"-imfchan", 1}, {"-blendv", 1}});
}

TEST_CASE("a texture is scaled by -s and moved by -o, with t upwards") {
  const core::Scene plain = square_with("map_Kd my wood.png").scene;
  const core::Scene placed = square_with("map_Kd -s 2 3 1 -o 0.5 0.25 my wood.png").scene;
  REQUIRE(placed.textures.size() == 1);
  REQUIRE(placed.corners.size() == plain.corners.size());
  for (std::size_t i = 0; i < plain.corners.size(); ++i) {
    const auto [s, t] = plain.corners[i].place;
    const auto [moved_s, moved_t] = placed.corners[i].place;
    CHECK(moved_s == 2 * s + 0.5F);
    CHECK(1 - moved_t == 3 * (1 - t) + 0.25F);
  }
}

TEST_CASE("textures without a name are found by the lines and letters by which options are, whatever ends a line") {
  const auto note = [](const std::string& file) {
    MtlTextures textures;
    return plain_mtl("a.mtl", file, textures).note;
  };
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    CAPTURE(end);
    std::string file;
    for (const std::string line : {"newmtl a", "\tMAP_kd wood.png", "map_KD ", "map_Kdx", "map_Kd"}) {
      file += line + end;
    }
    CHECK(note(file) == "a.mtl: map_Kd names no file in line 3 and 1 others: there the plain colour is shown");
    CHECK_THROWS_WITH_AS(note("newmtl a" + end + "map_Kd -s 2 2 " + std::string(1020, 'x')),
                         "a.mtl names a texture in 1027 bytes in line 2; expected at most 1023", core::InputError);
  }
  CHECK(note("\xef\xbb\xbfmap_Kd") == "a.mtl: map_Kd names no file in line 1: there the plain colour is shown");
  CHECK(note("map_Kd " + std::string(1023, 'x')).empty());
}

TEST_CASE("what is not followed is said once a kind") {
  const MeshFile file = square_with("map_Kd -mm 0.5 1 my wood.png");
  CHECK(file.scene.textures.size() == 1);
  bool is_said = false;
  for (const std::string& note : file.notes) {
    is_said = is_said || note == "textures' option -mm, which is not followed: 1";
  }
  CHECK(is_said);
}

TEST_CASE("a material without options lays its texture as another of its name before said, and no longer") {
  MtlTextures textures;
  plain_mtl("a.mtl", "newmtl a\nmap_Kd -s 2 2 x.png\nnewmtl b\nmap_Kd -s 3 3 x.png\nnewmtl a\nmap_Kd x.png\n", textures);
  CHECK(textures.places.at("a").is_plain());
  CHECK_FALSE(textures.places.at("b").is_plain());
}

TEST_CASE("a file of materials is found in other letters' case") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj", "mtllib Paint.MTL\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\n");
  tests::write_text(folder / "paint.mtl", "newmtl red\nKd 0.5 0 0\n");
  const MeshFile file = read_mesh_file(folder / "a.obj");
  REQUIRE(file.scene.materials.size() >= 1);
  CHECK(file.scene.materials[file.scene.objects[0].material].color == core::Vec3d{0.5, 0, 0});
  CHECK(std::count(file.notes.begin(), file.notes.end(),
                   "a file of materials was found under another name: paint.mtl for Paint.MTL") == 1);
}

}  // namespace dmpc::apps::mtl_text_test

// Files of materials.

#include "apps/foreign/obj/mtl.h"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/complaint.h"
#include "tests/support/text.h"

namespace dmpc::apps::obj::mtl_test {

using core::Vec3d;

namespace {

struct Parsed {
  std::vector<MtlMaterial> materials;
  std::vector<std::string> notes;
};

Parsed parse(const std::string& text) {
  Parsed parsed;
  parse_mtl(
      text, [&parsed](MtlMaterial material) { parsed.materials.push_back(std::move(material)); }, parsed.notes);
  return parsed;
}

MtlMaterial material_with(const std::string& lines) { return parse("newmtl a\n" + lines).materials.at(0); }

std::string refusal(const std::string& text) {
  return tests::complaint_of([&] { parse(text); });
}

}  // namespace

TEST_CASE("a material has what its statements say, in small letters or large, with remarks behind them") {
  const MtlMaterial material = material_with(
      "Kd 0.1 0.2 0.3 # red\n\tKS 0.5\r\nKe 3 2 1\nTf 1 0 0\nNs 50\nNi 1.5\nillum 3\nd 0.5\nTr 0.5\nPr 0.25\nPm 1\nPc 0.5\nKa 1 "
      "1 1\n");
  CHECK(material.diffuse == Vec3d{0.1, 0.2, 0.3});
  CHECK(material.specular == Vec3d{0.5, 0.5, 0.5});
  CHECK(material.emission == Vec3d{3, 2, 1});
  CHECK(material.filter == Vec3d{1, 0, 0});
  CHECK(material.shine == 50);
  CHECK(material.refraction_index == 1.5);
  CHECK(material.illumination == 3);
  CHECK(material.roughness == 0.25);
  CHECK(material.metallic == 1);
  CHECK(material.has_clear_coat);
  CHECK_FALSE(contradicts_itself(material));
  CHECK(parse("newmtl a b # c\nnewmtl d\n").materials.size() == 2);
  CHECK(parse("newmtl a b # c").materials.at(0).name == "a b # c");
  CHECK(parse("").materials.empty());
}

TEST_CASE("values that are none are refused with their line") {
  CHECK(refusal("newmtl a\nKd 1 1x 1") == "line 2: found '1x', expected a number");
  CHECK(refusal("newmtl a\nKd 1 1") == "line 2: found the end of the line, expected a number");
  CHECK(refusal("newmtl a\nKd 1 1 1 1") == "line 2: found '1', expected the end of the line");
  CHECK(refusal("newmtl a\nNs nan") == "line 2: found 'nan', expected a number");
  CHECK(refusal("newmtl a\nd") == "line 2: found the end of the line, expected a number");
  CHECK(refusal("Kd 1 1 1") == "line 1: expected 'newmtl NAME' before 'kd'");
}

TEST_CASE("d says how opaque a material is, whatever Tr says, and that they contradict each other is known") {
  CHECK(opacity_of(material_with("")) == 1);
  CHECK(opacity_of(material_with("d 0.25")) == 0.25);
  CHECK(opacity_of(material_with("d -halo 0.25")) == 0.25);
  CHECK(opacity_of(material_with("Tr 0.25")) == 0.75);
  for (const std::string both : {"d 1\nTr 1", "Tr 1\nd 1"}) {
    CHECK(opacity_of(material_with(both)) == 1);
    CHECK(contradicts_itself(material_with(both)));
  }
  CHECK_FALSE(contradicts_itself(material_with("d 0.3\nTr 0.7")));
}

TEST_CASE("colours by spectral curves and CIE XYZ are none, and known to be there") {
  const MtlMaterial material = material_with("Kd xyz 0.3 0.3 0.3\nKs spectral a.rfl 1\n");
  CHECK(material.has_other_colors);
  CHECK_FALSE(material.diffuse.has_value());
  CHECK(shown_material(material).color == Vec3d{0.6, 0.6, 0.6});
}

TEST_CASE("a texture keeps its name, whatever options stand before it") {
  using Case = std::pair<const char*, const char*>;
  for (const auto& [line, name] :
       {Case{"wood.png", "wood.png"}, Case{"-s 2 2 2 wood.png", "wood.png"}, Case{"-s 2 wood.png", "wood.png"},
        Case{"-o .5 1e1 -s 3 my wood.png\r", "my wood.png"}, Case{"-blendu off -clamp on wood.png", "wood.png"},
        Case{"-s 2 2 2", "2"}, Case{"-s", "-s"}, Case{"-wood.png", "-wood.png"}, Case{"wood #1.png", "wood #1.png"}}) {
    CAPTURE(line);
    const MtlMaterial material = material_with(std::string("map_Kd ") + line);
    REQUIRE(material.texture.has_value());
    CHECK(material.texture->name == name);
  }
  CHECK(material_with("map_kd -clamp on a.png").texture->edges.s == core::TextureWrap::clamp);
  CHECK(material_with("map_Kd -clamp on -clamp off a.png").texture->edges.t == core::TextureWrap::repeat);
  CHECK(material_with("map_Bump -bm 0.5 b.png\nrefl -type sphere c.png\nmap_Ks b.png").other_textures.size() == 2);
}

TEST_CASE("options that are not followed are known, unless they change nothing") {
  CHECK(texture_words("-mm 0 1 -t 0 0 0 -blendu on -cc off -boost 0 -s 2 2 -o 1 wood.png").left_out.empty());
  CHECK(texture_words("-MM 0.5 -imfchan r -blendv off a.png").left_out == std::vector<std::string>{"-mm", "-imfchan", "-blendv"});
}

TEST_CASE("-s and -o scale and move places, with t upwards") {
  const TexturePlace place = texture_words("-s 2 3 1 -o 0.5 0.25 a.png").place;
  const auto [s, t] = place(1, 1 - 2);
  CHECK(s == 2 * 1 + 0.5);
  CHECK(1 - t == 3 * 2 + 0.25);
  CHECK(texture_words("a.png").place.is_plain());
}

TEST_CASE("textures without a name and unknown statements are said with their line") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string file;
    for (const std::string line : {"newmtl a", "\tMAP_kd wood.png", "map_KD ", "map_Kd # x", "foo 1"}) {
      file += line + end;
    }
    CHECK(parse(file).notes ==
          std::vector<std::string>{"map_Kd names no file in line 3 and 1 others: there the plain colour is shown",
                                   "unknown statements left out: 1, 'foo' in line 5"});
  }
}

TEST_CASE("a million materials are handed over one by one") {
  const std::string many = tests::repeated(1'000'000, "newmtl a\n");
  std::size_t count = 0;
  std::vector<std::string> notes;
  parse_mtl(
      many, [&count](const MtlMaterial&) { ++count; }, notes);
  CHECK(count == 1'000'000);
}

}  // namespace dmpc::apps::obj::mtl_test

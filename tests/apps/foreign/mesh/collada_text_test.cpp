#include "apps/foreign/mesh/collada_text.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/formats/mesh_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::collada_text_test {

namespace {

core::Material material_by(const std::string& shader) {
  const TemporaryFolder folder;
  write_text(folder / "a.dae", collada(shader));
  return apps::read_mesh_file(folder / "a.dae").scene.materials.at(0);
}

}  // namespace

TEST_CASE("a Collada effect mirrors only where the file's own words say so") {
  const std::string red = "<diffuse><color>1 0 0 1</color></diffuse>", shiny = "<shininess><float>20</float></shininess>";
  const std::string white = "<specular><color>1 1 1 1</color></specular>";
  for (const std::string& shader :
       {"<lambert>" + red + "</lambert>", "<constant>" + shiny + "</constant>", "<phong>" + red + "</phong>",
        "<blinn >" + red + shiny + "</blinn>", "<lambert>" + white + shiny + "</lambert>", std::string("<lambert/>")}) {
    CAPTURE(shader);
    CHECK(material_by(shader).specular == 0);
  }
  CHECK(material_by("<lambert>" + red + "</lambert>").color == core::Vec3d{1, 0, 0});
  CHECK(material_by("<lambert>" + red + "</lambert>").diffuse == 1);
  CHECK(material_by("<phong>" + red + white + shiny + "</phong>").specular > 0);
  CHECK(material_by("<phong>" + red + white + shiny + "</phong>").shine == 20);
}

TEST_CASE("what stands in remarks and verbatim is no tag, and nothing else changes") {
  const std::string text = "<a><!-- <lambert/> --><![CDATA[<phong>]]><phongs/>< ></a><lambert";
  CHECK(apps::collada_in_full(text) == text);
  CHECK(apps::collada_in_full("") == "");
  CHECK(apps::collada_in_full("<perspective><yfov>9</yfov></perspective>") ==
        "<perspective><aspect_ratio>1</aspect_ratio><yfov>9</yfov></perspective>");
  CHECK(apps::collada_in_full(R"(<camera id="c">)") == R"(<camera id="c" name="c">)");
  CHECK(apps::collada_in_full(R"(<camera id="c" name="d">)") == R"(<camera id="c" name="d">)");
  const std::string both = "<perspective><xfov>9</xfov><yfov>9</yfov></perspective>";
  CHECK(apps::collada_in_full(both) == both);
}

TEST_CASE("the sets of texture coordinates are those of the inputs") {
  CHECK(apps::collada_texture_sets(R"(<input semantic="TEXCOORD" offset="1" set="2"/><input set='7' semantic='TEXCOORD'/>)"
                                   R"(<input semantic="NORMAL" set="1"/><inputs semantic="TEXCOORD" set="3"/>)") ==
        std::set<unsigned>{2, 7});
  CHECK(apps::collada_texture_sets(R"(<input semantic="TEXCOORD" source="#u"/>)") == std::set<unsigned>{0});
}

}  // namespace dmpc::tests::collada_text_test

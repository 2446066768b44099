#include "apps/foreign/mesh/collada_text.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "apps/formats/mesh_file.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
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

TEST_CASE("constant shading is its own light alone") {
  const core::Material material = material_by("<constant><emission><color>0 1 0 1</color></emission></constant>");
  CHECK(material.color == core::Vec3d{0, 0, 0});
  CHECK(material.emission == core::Vec3d{0, 1, 0});
}

TEST_CASE("a Collada material that mirrors by a colour of its own is said, unless its share is 0") {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& more) {
    write_text(folder / "a.dae", collada("<phong><reflective><color>1 1 1 1</color></reflective>" + more + "</phong>"));
    const auto notes = apps::read_mesh_file(folder / "a.dae").notes;
    return std::find(notes.begin(), notes.end(),
                     "materials that mirror by a colour of their own (reflective), shown without that: 1") != notes.end();
  };
  CHECK(says(""));
  CHECK(says("<reflectivity><float>0.5</float></reflectivity>"));
  CHECK_FALSE(says("<reflectivity><float>0</float></reflectivity>"));
}

TEST_CASE("faces that are bound to no material are grey, and no other's") {
  const std::string red = "<lambert><diffuse><color>1 0 0 1</color></diffuse></lambert>";
  const TemporaryFolder folder;
  for (const char* const other : {R"(material="other")", "", R"(material="m")"}) {
    CAPTURE(other);
    std::string text = collada(red);
    text.replace(text.find(R"(material="S")"), 12, other);
    write_text(folder / "a.dae", text);
    const core::Scene scene = apps::read_mesh_file(folder / "a.dae").scene;
    CHECK(length(scene.materials.at(scene.objects.at(0).material).color - core::Vec3d{0.6, 0.6, 0.6}) < 1e-6);
  }
  write_text(folder / "a.dae", collada(red));
  const core::Scene scene = apps::read_mesh_file(folder / "a.dae").scene;
  CHECK(scene.materials.at(scene.objects.at(0).material).color == core::Vec3d{1, 0, 0});
}

namespace {

apps::MeshFile read_with(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return read_mesh("a.dae", text);
}

}  // namespace

TEST_CASE("a Collada material or effect that leads nowhere is said by name, and grey") {
  const std::string red = collada("<lambert><diffuse><color>1 0 0 1</color></diffuse></lambert>");
  const core::Vec3d grey{0.6, 0.6, 0.6};
  const auto is_grey = [&](const apps::MeshFile& file) { return length(material_of_object(file, 0).color - grey) < 1e-6; };
  const apps::MeshFile material = read_with(red, R"(target="#m")", R"(target="#n")");
  CHECK(notes(material, "materials that are bound and not in the file, shown grey: 'n'"));
  CHECK(is_grey(material));
  const apps::MeshFile effect = read_with(red, R"(url="#e")", R"(url="#f")");
  CHECK(notes(effect, "materials whose effect is not in the file, shown grey: 'm'"));
  CHECK(is_grey(effect));
  CHECK_FALSE(notes(read_mesh("a.dae", red), "shown grey"));
}

TEST_CASE("a Collada effect of another profile than COMMON is grey, without a highlight, and said") {
  std::string text = collada("<phong/>");
  for (std::size_t at = text.find("profile_COMMON"); at != std::string::npos; at = text.find("profile_COMMON")) {
    text.replace(at, 14, "profile_GLSL");
  }
  const apps::MeshFile file = read_mesh("a.dae", text);
  CHECK(notes(file, "profiles of effects other than COMMON, which are not shown: an effect without that is grey: 1"));
  CHECK(material_of_object(file, 0).specular == 0);
  CHECK(length(material_of_object(file, 0).color - core::Vec3d{0.6, 0.6, 0.6}) < 1e-6);
}

TEST_CASE("what of Collada Assimp passes over is said with a count") {
  const auto says = [](const std::string& shader, const std::string& nodes, const std::string& note) {
    return notes(read_mesh("a.dae", collada(shader, "", nodes)), note);
  };
  const auto says_of = [](const std::string& shader) {
    return notes(read_mesh("a.dae", collada(shader)), "materials with factors outside 0 to 1, brought into it: 1");
  };
  CHECK(says_of("<lambert><diffuse><color>2 0 0 1</color></diffuse></lambert>"));
  CHECK(says_of("<phong><shininess><float>-4</float></shininess></phong>"));
  CHECK_FALSE(says_of("<phong><emission><color>2 0 0 1</color></emission><shininess><float>4</float></shininess></phong>"));
  const apps::MeshFile splines = read_with(collada("<lambert/>"), "<mesh>", "<spline closed=\"0\"></spline><mesh>");
  CHECK(notes(splines, "splines, boundaries and hulls (spline, brep, convex_mesh), which are not shown: 1"));
  const std::string by_name = R"(<lambert><diffuse><param ref="c"/></diffuse></lambert>)";
  CHECK(says(by_name, "", "values by a parameter's name (param ref), which are not followed: 1"));
  CHECK(says("<lambert/>", "<node><extra><wrap_s> CLAMP</wrap_s></extra></node>",
             "edges of textures other than WRAP (wrap_s, wrap_t), shown as WRAP: 1"));
  CHECK(contains(mesh_refusal("a.dae", collada("<lambert/>", "", "<node><skew>45 0 1 0 1 0 0</skew></node>")),
                 "a node is skewed, which is not shown; write its transforms as one matrix"));
  CHECK_FALSE(says("<lambert/>", "", "not followed"));
}

TEST_CASE("values of Collada come in the order in which they stand, whatever they are called") {
  const apps::MeshFile plain = read_mesh("a.dae", collada("<lambert/>"));
  std::string text = collada("<lambert/>"), nameless = text;
  for (const std::string letter : {"X", "Y", "Z"}) {
    const std::string name = "name=\"" + letter + "\"";
    text.replace(text.find(name), name.size(), "name=\"place_" + letter + "\"");
    nameless.erase(nameless.find(name), name.size());
  }
  CHECK(read_mesh("a.dae", text).scene.vertices == plain.scene.vertices);
  CHECK(read_mesh("a.dae", nameless).scene.vertices == plain.scene.vertices);
}

namespace {

/// Faces with two sets of texture coordinates, of which the effect's texture has `channel`; what of the instance binds it.
std::string with_two_sets(const std::string& channel, const std::string& bound, const std::string& url = "#g") {
  return R"(<material id="m"><instance_effect url="#e"/></material><effect id="e"><diffuse><texture texture="t" texcoord=")" +
         channel +
         R"("/></diffuse></effect><geometry id="g"><triangles material="S"><input semantic="TEXCOORD" offset="1" set="0"/>)"
         R"(<input semantic="TEXCOORD" offset="2" set="1"/><p>0</p></triangles></geometry><instance_geometry url=")" +
         url + R"("><instance_material symbol="S" target="#m">)" + bound + "</instance_material></instance_geometry>";
}

/// Whether the input at `offset` is the first set of those that Assimp gets.
bool is_first(const std::string& text, int offset) {
  return apps::collada_in_full(text).find("offset=\"" + std::to_string(offset) + R"(" set="0")") != std::string::npos;
}

}  // namespace

TEST_CASE("the set of texture coordinates that is bound comes first, else the one in the texture's name, else the first") {
  const std::string to_0 = R"(<bind_vertex_input semantic="CHANNEL1" input_semantic="TEXCOORD" input_set="0"/>)",
                    to_1 = R"(<bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="1"/>)";
  CHECK(is_first(with_two_sets("CHANNEL1", to_0), 1));
  CHECK(is_first(with_two_sets("UV", to_1), 2));
  CHECK(is_first(with_two_sets("CHANNEL1", ""), 2));
  CHECK(is_first(with_two_sets("UV", ""), 1));
  CHECK(is_first(with_two_sets("CHANNEL7", ""), 1));
  CHECK_FALSE(is_first(with_two_sets("UV", to_1), 1));
}

TEST_CASE("faces that are not closed do not make the text grow") {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    text += R"(<triangles><input semantic="TEXCOORD" set="1"/>)";
  }
  CHECK(apps::collada_in_full(text).size() < 2 * text.size());
}

TEST_CASE("a geometry that shows its texture by two sets in two places is refused") {
  const std::string twice =
      with_two_sets("CHANNEL1", "") + with_two_sets("CHANNEL1", R"(<bind_vertex_input semantic="CHANNEL1" input_set="0"/>)");
  CHECK_THROWS_WITH_AS(apps::collada_in_full(twice), doctest::Contains("the geometry 'g' shows a texture by set"),
                       core::InputError);
}

}  // namespace dmpc::tests::collada_text_test

// Each parameter of each statement of pbrt-v4 is used, reported, or changes no picture: all rows of the table are checked.
#include "apps/foreign/pbrt/parameter_table.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

#include "tests/support/pbrt_scenes.h"

namespace dmpc::apps::pbrt_parameter_table_test {

using pbrt::ListedParameter;
using pbrt::parameter_table;
using pbrt::ParameterRow;
using tests::notes;

namespace {

/// Where what most values of a type are would be refused.
std::string value_of(const std::string& kind, const ListedParameter& parameter) {
  static const std::map<std::string, std::string> of_names{
      {"pixelbounds", "[0 1 0 1]"},    {"cropwindow", "[0 1 0 1]"},
      {"screenwindow", "[-1 1 -1 1]"}, {"whitebalance", "5000"},
      {"sensor", "\"cie1931\""},       {"indices", "[0 1 2]"},
      {"P", "[0 0 0 1 0 0 0 1 0]"},    {"uv", "[0 0 1 0 0 1]"},
      {"N", "[0 0 1 0 0 1 0 0 1]"},    {"S", "[1 0 0 1 0 0 1 0 0]"},
      {"faceIndices", "[0]"},          {"materials", "[\"a\" \"b\"]"},
      {"mapping", "\"uv\""},           {"wrap", "\"clamp\""},
      {"encoding", "\"sRGB\""},        {"dimension", "2"},
      {"filename", "\"part.ply\""},    {"portal", "[0 0 0 1 0 0 1 1 0 0 1 0]"},
      {"displacement", "\"number\""},
  };
  static const std::map<std::string, std::string> of_types{{"float", "0.5"},     {"integer", "3"},         {"bool", "true"},
                                                           {"string", "\"x\""},  {"rgb", "[0.5 0.5 0.5]"}, {"vector3", "[0 1 0]"},
                                                           {"point3", "[1 2 3]"}};
  static const std::map<std::string, std::string> of_quads{{"indices", "[0 1 2 3]"},
                                                           {"P", "[0 0 0 1 0 0 0 1 0 1 1 0]"},
                                                           {"uv", "[0 0 1 0 0 1 1 1]"},
                                                           {"N", "[0 0 1 0 0 1 0 0 1 0 0 1]"}};
  const std::string name(parameter.name);
  if (kind == "bilinearmesh" && of_quads.contains(name)) {
    return of_quads.at(name);
  }
  return of_names.contains(name) ? of_names.at(name) : of_types.at(std::string(parameter.type));
}

/// Without which the statement is refused, whatever else it says.
std::string needed_by(const std::string& kind) {
  static const std::map<std::string, std::string> needed{
      {"trianglemesh", " \"point3 P\" [0 0 0 1 0 0 0 1 0]"}, {"bilinearmesh", " \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]"},
      {"loopsubdiv", " \"point3 P\" [0 0 0 1 0 0 0 1 0]"},   {"plymesh", " \"string filename\" \"part.ply\""},
      {"imagemap", " \"string filename\" \"part.png\""},     {"mix", " \"string materials\" [\"a\" \"b\"]"},
  };
  return needed.contains(kind) ? needed.at(kind) : "";
}

const std::string before = "Scale -1 1 1 LookAt 0 0 10  0 0 0  0 1 0\n";
const std::string named =
    "Texture \"number\" \"float\" \"constant\" \"float value\" 0.25\n"
    "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"b\" \"string type\" \"diffuse\"\n";

/// Each parameter of the row's in a statement of its own, and one that none has.
std::string scene_of(const ParameterRow& row) {
  const std::string statement(row.statement), kind(row.kind);
  const bool is_first = statement == "Film" || statement == "Camera" || statement == "Sampler" || statement == "PixelFilter" ||
                        statement == "Integrator" || statement == "Accelerator" || statement == "Option";
  const std::string needed = statement == "Texture" && kind == "mix" ? "" : needed_by(kind);
  auto begin = [&, textures = 0]() mutable {
    return statement + (statement == "Texture" ? " \"t" + std::to_string(++textures) + "\" \"spectrum\"" : "") +
           (statement == "Option" ? "" : " \"" + kind + "\"") + needed + " ";
  };
  std::string words = begin() + "\"float wizard\" 1\n";
  for (std::string_view list : {row.used, row.said, row.silent}) {
    while (!list.empty()) {
      const ListedParameter parameter = pbrt::next_of(list);
      words += begin() + "\"" + std::string(parameter.type) + " " + std::string(parameter.name) + "\" " +
               value_of(kind, parameter) + "\n";
    }
  }
  return before + (is_first ? words : "") + "WorldBegin\n" + named + (is_first ? "" : words) + tests::pbrt_triangle;
}

MeshFile read(const std::string& scene) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "part.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  tests::write_text(folder / "a.pbrt", scene);
  return read_mesh_file(folder / "a.pbrt");
}

bool is_named(const MeshFile& file, const std::string& name) {
  return notes(file, "parameters \"" + name + "\"") || notes(file, "\"" + name + "\" of ");
}

}  // namespace

TEST_CASE(
    "each parameter of pbrt-v4 is shown, said with its statement, or changes no picture, and what it does not have is said") {
  for (const ParameterRow& row : parameter_table()) {
    const std::string scene = scene_of(row);
    CAPTURE(scene);
    const MeshFile file = read(scene);
    CHECK(notes(file, "parameters \"wizard\" that mean nothing where they stand: 1"));
    for (std::string_view list : {row.used, row.silent}) {
      while (!list.empty()) {
        const std::string name(pbrt::next_of(list).name);
        CAPTURE(name);
        CHECK(!is_named(file, name));
      }
    }
    const std::string of = " of " + std::string(row.statement) + (row.kind.empty() ? "" : " \"" + std::string(row.kind) + "\"");
    for (std::string_view list = row.said; !list.empty();) {
      const std::string name(pbrt::next_of(list).name);
      CAPTURE(name);
      CHECK(notes(file, "\"" + name + "\"" + of + ", which is not shown: 1"));
    }
  }
}

TEST_CASE("a list of parameters is taken one by one") {
  std::string_view list = "float a, point3 b";
  const ListedParameter first = pbrt::next_of(list), second = pbrt::next_of(list);
  CHECK(first.type == "float");
  CHECK(first.name == "a");
  CHECK(second.type == "point3");
  CHECK(second.name == "b");
  CHECK(list.empty());
  CHECK(pbrt::fate_of("Film", "rgb", "maxcomponentvalue") == pbrt::ParameterFate::said);
  CHECK(pbrt::fate_of("Film", "rgb", "imagingratio") == pbrt::ParameterFate::unknown);
  CHECK(pbrt::fate_of("Film", "square", "iso") == pbrt::ParameterFate::unknown);
}

}  // namespace dmpc::apps::pbrt_parameter_table_test

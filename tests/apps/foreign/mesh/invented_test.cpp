#include "apps/foreign/mesh/invented.h"

#include <doctest/doctest.h>

#include <string>

#include "apps/formats/mesh_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::invented_test {

namespace {

/// The first material of a triangle in FBX, shaded by this model with an exponent of 20 and a specular colour of 0.5.
core::Material material_of_fbx(const std::string& model, const std::string& link = " C: \"OO\",300,200\n") {
  const std::string triangle =
      "Geometry: 100, \"Geometry::\", \"Mesh\" {\n Vertices: *9 {\n a: 0,0,0,2,0,0,0,1,0\n }\n PolygonVertexIndex: *3 {\n a: "
      "0,1,-3\n }\n"
      " LayerElementMaterial: 0 {\n  MappingInformationType: \"AllSame\"\n  ReferenceInformationType: \"IndexToDirect\"\n"
      "  Materials: *1 {\n   a: 0\n  }\n }\n Layer: 0 {\n  LayerElement:  {\n   Type: \"LayerElementMaterial\"\n   TypedIndex: "
      "0\n  }\n }\n}\nModel: 200, \"Model::a\", \"Mesh\" {\n Version: 232\n}\n";
  const std::string material = "Material: 300, \"Material::m\", \"\" {\n ShadingModel: \"" + model +
                               "\"\n Properties70:  {\n"
                               "  P: \"DiffuseColor\", \"Color\", \"\", \"A\",1,0,0\n"
                               "  P: \"SpecularColor\", \"Color\", \"\", \"A\",0.5,0.5,0.5\n"
                               "  P: \"ShininessExponent\", \"Number\", \"\", \"A\",20\n }\n}\n";
  const TemporaryFolder folder;
  write_text(folder / "a.fbx",
             "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\nObjects:  {\n" +
                 triangle + material + "}\nConnections:  {\n C: \"OO\",200,0\n C: \"OO\",100,200\n" + link + "}\n");
  return apps::read_mesh_file(folder / "a.fbx").scene.materials.at(0);
}

}  // namespace

TEST_CASE("AMF without colours is grey, not black") {
  const TemporaryFolder folder;
  std::string corners;
  for (const char* place : {"<x>0</x><y>0</y><z>0</z>", "<x>1</x><y>0</y><z>0</z>", "<x>0</x><y>1</y><z>0</z>"}) {
    corners += std::string("<vertex><coordinates>") + place + "</coordinates></vertex>";
  }
  write_text(folder / "a.amf",
             "<?xml version=\"1.0\"?><amf><object id=\"0\"><mesh><vertices>" + corners +
                 "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object>"
                 "</amf>");
  const core::Scene scene = apps::read_mesh_file(folder / "a.amf").scene;
  CHECK(length(scene.materials.at(scene.objects.at(0).material).color - core::Vec3d{0.6, 0.6, 0.6}) < 1e-6);
}

TEST_CASE("an FBX material mirrors by its own words alone: Phong's exponent is no roughness, and Lambert has no highlight") {
  CHECK(material_of_fbx("phong").color == core::Vec3d{1, 0, 0});
  CHECK(material_of_fbx("phong").shine == 20);
  CHECK(material_of_fbx("phong").specular > 0);
  CHECK(material_of_fbx("lambert").specular == 0);
  CHECK(material_of_fbx("lambert").diffuse == 1);
}

TEST_CASE("what has no material is of one grey, whatever grey an importer has for it") {
  const core::Vec3d grey{0.6, 0.6, 0.6};
  CHECK(length(material_of_fbx("phong", "").color - grey) < 1e-6);
  const TemporaryFolder folder;
  write_text(folder / "a.x", "xof 0303txt 0032\nMesh a {\n3;\n0;0;0;,\n2;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\n}\n");
  CHECK(length(apps::read_mesh_file(folder / "a.x").scene.materials.at(0).color - grey) < 1e-6);
}

TEST_CASE("the camera of an ASE file looks forwards") {
  const std::string models = DMPC_MODELS;
  const core::View view = apps::read_mesh_file(models + "/ASE/CameraRollAnim.ase").scene.view;
  CHECK(dot(core::Vec3d{10, 19, 0} - view.from, view.at - view.from) > 0);  // the middle of the scene lies before it
}

}  // namespace dmpc::tests::invented_test

#include "apps/foreign/mesh/bare_meshes.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"

namespace dmpc::tests::bare_meshes_test {

namespace {

/// A triangle of X, with more inside its block.
std::string mesh(const std::string& more) { return "Mesh {\n3;\n0;0;0;,\n2;0;0;,\n0;1;0;;\n1;\n3;0,1,2;;\n" + more + "}\n"; }

const std::string head = "xof 0303txt 0032\ntemplate Mesh {\n<3D82AB44-62DA-11cf-AB39-0020AF71E433>\n}\n# Mesh {\n",
                  list = "MeshMaterialList {\n1;\n1;\n0;;\nMaterial {\n1;0;0;1;;\n0;\n0;0;0;;\n0;0;0;;\n}\n}\n";
const std::string said =
    "meshes without a material of their own, or of which that is not known, which may have the file's first: 1";

}  // namespace

TEST_CASE("a mesh of X that has no material beside others that have one is said") {
  CHECK(notes(read_mesh("a.x", head + mesh(list) + mesh("")), said));
  CHECK_FALSE(notes(read_mesh("a.x", head + mesh(list) + mesh(list)), "meshes without a material"));
  CHECK_FALSE(notes(read_mesh("a.x", head + mesh("") + mesh("")), "meshes without a material"));
}

}  // namespace dmpc::tests::bare_meshes_test

#include "apps/foreign/mesh/file_numbers.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::tests::file_numbers_test {

TEST_CASE("a word that begins as a number and is none is an error with its line, where Assimp would read its begin") {
  CHECK_THROWS_WITH_AS(apps::check_numbers("; FBX 7.4x\na: 0,1,\n 2x,3\n", "fbx"), "line 3: found '2x', expected a number",
                       core::InputError);
  CHECK_THROWS_AS(apps::check_numbers("*MESH_VERTEX 0 0 0 -1.#IND\n", "ase"), core::InputError);
  CHECK_THROWS_WITH_AS(apps::check_numbers("<x>\n10.0D-01</x>", "amf"), "line 2: found '10.0D-01', expected a number",
                       core::InputError);
  CHECK_THROWS_AS(apps::check_numbers("<float_array id='a'>1 2 .5f</float_array>", "dae"), core::InputError);
}

TEST_CASE("numbers, names, remarks and what stands in quotes are no errors") {
  apps::check_numbers("; FBX 7.4x\nVertices: *9 {\n a: -1.5e3,+.5,2 }\n P: \"3x\", \"4y\", Y, T\nC: \"OO\",1,0\n", "fbx");
  apps::check_numbers("*MESH_FACE 0: A: 0 B: 1 *MESH_SMOOTHING 1,2 *COMMENT \"1x\"\n", "ase");
  apps::check_numbers("<metadata>1x</metadata><x> 1 </x><!-- <x>1x</x> -->", "amf");
  apps::check_numbers("Kaydara FBX Binary 1x", "fbx");
  apps::check_numbers("1x", "lwo");
}

}  // namespace dmpc::tests::file_numbers_test

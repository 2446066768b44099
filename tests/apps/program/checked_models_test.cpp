// dmpc check on models of Debian's assimp-testmodels.
#include <doctest/doctest.h>

#include <string>

#include "tests/support/child_process.h"
#include "tests/support/text.h"

namespace dmpc::tests::checked_models_test {

TEST_CASE("Embree explains every ray on models") {
  for (const std::string path : {"OBJ/spider.obj", "glTF2/ClearCoat-glTF/ClearCoatTest.gltf"}) {
    CAPTURE(path);
    ChildProcess check({DMPC_PROGRAM, "check", DMPC_MODELS "/" + path, "--resolution=64x64"});
    CHECK(check.status() == 0);
    CHECK(contains(check.output(), "Failed: nothing."));
  }
}

}  // namespace dmpc::tests::checked_models_test

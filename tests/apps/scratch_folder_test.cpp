#include "apps/scratch_folder.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "apps/output_file.h"

namespace dmpc::tests {

TEST_CASE("a scratch folder is there while it lives and goes with its files") {
  std::filesystem::path file;
  {
    const apps::ScratchFolder folder, other;
    file = folder / "file";
    CHECK(file != other / "file");
    apps::write_file(file, "text");
    CHECK(std::filesystem::exists(file));
  }
  CHECK_FALSE(std::filesystem::exists(file.parent_path()));
}

}  // namespace dmpc::tests

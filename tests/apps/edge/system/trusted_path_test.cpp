#include "apps/edge/system/trusted_path.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.h"

namespace dmpc::tests::trusted_path_test {

namespace {

namespace fs = std::filesystem;

/// A folder's file, as nobody else may write it at first.
struct Lying {
  TemporaryFolder folder;
  fs::path file = fs::canonical(folder.path()) / "inner/file";

  Lying() {
    fs::create_directory(file.parent_path());
    write_text(file, "code");
    fs::permissions(file.parent_path(), fs::perms(0755));
    fs::permissions(file, fs::perms(0755));
  }
  std::string why() const { return apps::why_untrusted(file).value_or("trusted"); }
};

}  // namespace

TEST_CASE("code is trusted where nobody else may write it, nor put another in its place") { CHECK(Lying().why() == "trusted"); }

TEST_CASE("code that everybody may write is not trusted") {
  const Lying lying;
  fs::permissions(lying.file, fs::perms(0757));
  CHECK(lying.why() == "everybody may write to it");
}

TEST_CASE("code in a folder that everybody may write to is trusted only if nobody may remove what is another's") {
  const Lying lying;
  const fs::path inner = lying.file.parent_path(), outer = inner.parent_path();
  for (const fs::path& folder : {inner, outer}) {
    fs::permissions(folder, fs::perms(0777));
    CHECK(lying.why() == "of " + folder.string() + ", where it lies: everybody may write to it");
    fs::permissions(folder, fs::perms(01777));
    CHECK(lying.why() == "trusted");
  }
}

TEST_CASE("code of another user, or in another's folder, or for another group to write, is not trusted") {
  const Lying lying;
  if (::geteuid() != 0 || ::chown(lying.file.c_str(), 65533, 65533) != 0 || ::chown(lying.file.c_str(), 0, 0) != 0) {
    MESSAGE("left out: only a root who knows other users can make files of others");
    return;
  }
  const fs::path inner = lying.file.parent_path();
  CHECK(::chown(lying.file.c_str(), 65533, 0) == 0);
  CHECK(lying.why() == "it belongs to user 65533");
  CHECK(::chown(lying.file.c_str(), 0, 65533) == 0);
  CHECK(lying.why() == "trusted");
  fs::permissions(lying.file, fs::perms(0775));
  CHECK(lying.why() == "group 65533 may write to it");
  fs::permissions(lying.file, fs::perms(0755));
  CHECK(::chown(inner.c_str(), 65533, 0) == 0);
  CHECK(lying.why() == "of " + inner.string() + ", where it lies: it belongs to user 65533");
}

}  // namespace dmpc::tests::trusted_path_test

#include "apps/frontend/system/trusted_path.h"

#include <doctest/doctest.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cstdint>
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

/// Lets user 65533 do what `rights` say (4 to read, 2 to write), as setfacl does.
bool give_rights(const fs::path& file, std::uint16_t rights) {
  struct Entry {
    std::uint16_t of, rights;
    std::uint32_t id;
  };
  constexpr std::uint32_t nobody = 0xffffffff;
  struct {
    std::uint32_t version = 2;
    std::array<Entry, 5> entries;
  } list;
  list.entries = {Entry{1, 6, nobody}, {2, rights, 65533}, {4, 4, nobody}, {16, rights, nobody}, {32, 4, nobody}};
  return ::setxattr(file.c_str(), "system.posix_acl_access", &list, sizeof(list), 0) == 0;
}

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

TEST_CASE("code that an access list lets somebody write is not trusted, in a group of the user's own either") {
  const Lying lying;
  if (!give_rights(lying.file, 4)) {
    MESSAGE("left out: here files have no access lists");
    return;
  }
  CHECK(lying.why() == "trusted");
  CHECK(give_rights(lying.file, 6));
  CHECK(lying.why() == "an access list lets others write to it");
}

}  // namespace dmpc::tests::trusted_path_test

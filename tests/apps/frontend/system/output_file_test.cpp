#include "apps/frontend/system/output_file.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string_view>

#include "apps/frontend/system/files.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::output_file_test {

using tests::file_text;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

void write_whole(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

TEST_CASE("a file that is not committed leaves nothing behind") {
  const TemporaryFolder folder;
  {
    OutputFile file(folder / "a.png");
    file.write("half");
    CHECK(folder.entry_count() == 1);
  }
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("what lies under the name of a file that is not whole yet, and cannot be removed, keeps nothing from being written") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(next_name(folder / "a"));  // as a file of somebody else's in a folder for all
  OutputFile file(folder / "a", {.name = TemporaryName::of_target});
  file.write("text");
  file.commit();
  CHECK(file_text(folder / "a") == "text");
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("an older file stays whole until the new one is committed") {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  OutputFile file(folder / "a.txt");
  file.write("new");
  CHECK(file_text(folder / "a.txt") == "old");
  file.commit();
  CHECK(file_text(folder / "a.txt") == "new");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a stream of any length arrives as it was written") {
  const TemporaryFolder folder;
  OutputFile file(folder / "a.txt");
  std::string expected;
  for (const std::size_t length : {0, 1, 70'000, 65'536, 3, 200'000}) {
    const std::string part(length, static_cast<char>('a' + length % 26));
    file.stream() << part << static_cast<char>(length % 7) << length;
    expected += part + static_cast<char>(length % 7) + std::to_string(length);
  }
  file.commit();
  CHECK(file_text(folder / "a.txt") == expected);
}

TEST_CASE("two processes with one number, in two containers, write one file without a clash") {
  const TemporaryFolder folder;
  OutputFile first(folder / "a.txt"), second(folder / "a.txt");
  first.write("first");
  second.write("second");
  first.commit();
  CHECK(file_text(folder / "a.txt") == "first");
  second.commit();
  CHECK(file_text(folder / "a.txt") == "second");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("what somebody has put where a file is made is neither opened nor followed") {
  const TemporaryFolder folder;
  write_text(folder / "precious", "old");
  std::filesystem::create_symlink(folder / "precious", next_name(folder / "a"));
  OutputFile file(folder / "a", {.name = TemporaryName::of_target});
  file.write("new");
  file.commit();
  CHECK(file_text(folder / "precious") == "old");
  CHECK_FALSE(std::filesystem::is_symlink(folder / "a"));
  CHECK(file_text(folder / "a") == "new");
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("a symbolic link stays and the file behind it is replaced") {
  const TemporaryFolder folder;
  write_text(folder / "real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_whole(folder / "link.txt", "new");
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(file_text(folder / "real.txt") == "new");
}

TEST_CASE("a symbolic link to a file that is not there has it made, and stays") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "far");
  std::filesystem::create_symlink("far/real.txt", folder / "near.txt");
  std::filesystem::create_symlink("near.txt", folder / "link.txt");
  check_output_path(folder / "link.txt", "-o");
  write_whole(folder / "link.txt", "new");
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(std::filesystem::is_symlink(folder / "near.txt"));
  CHECK(file_text(folder / "far/real.txt") == "new");
}

TEST_CASE("a symbolic link into a missing folder is refused with the folder's name, and one to itself by its own") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("nowhere/real.txt", folder / "link.txt");
  std::filesystem::create_symlink("self.txt", folder / "self.txt");
  CHECK_THROWS_WITH_AS(check_output_path(folder / "link.txt", "-o"), doctest::Contains("nowhere, make it first"),
                       core::InputError);
  CHECK_THROWS_WITH_AS(check_output_path(folder / "self.txt", "-o"),
                       doctest::Contains("self.txt: this symbolic link leads round in a circle"), core::InputError);
  CHECK(std::filesystem::is_symlink(folder / "self.txt"));
}

TEST_CASE("a file that is replaced keeps who may read and write it") {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "old");
  for (const std::filesystem::perms mode : {std::filesystem::perms{0600}, std::filesystem::perms{0664}}) {
    std::filesystem::permissions(folder / "a.txt", mode);
    write_whole(folder / "a.txt", "new");
    CHECK(std::filesystem::status(folder / "a.txt").permissions() == mode);
  }
}

TEST_CASE("what is no ordinary file is written to directly and never renamed over") {
  OutputFile file("/dev/null");
  file.write("text");
  file.commit();
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("a path into a missing folder is refused with the folder's name") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(
      check_output_path(folder / "nowhere/a.png", "-o"),
      ("-o " + (folder / "nowhere/a.png").string() + ": there is no folder " + (folder / "nowhere").string() + ", make it first")
          .c_str(),
      core::InputError);
}

TEST_CASE("a file for which this computer has no room is no bad input") {
  class FullTable : public Files {
   public:
    int open(const std::filesystem::path&, int) override {
      errno = ENFILE;
      return -1;
    }
    ssize_t read(int, std::span<char>) override { return -1; }
    ssize_t write(int, std::string_view) override { return -1; }
    int sync(int) override { return -1; }
    int close(int) override { return -1; }
    int rename(const std::filesystem::path&, const std::filesystem::path&) override { return -1; }
    int remove(const std::filesystem::path&) override { return -1; }
  } files;
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_file(folder / "a", "text", Durability::until_power_loss, files), ComputerCapacityError);
}

TEST_CASE("a folder or an empty name is no output") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(check_output_path(folder.path(), "-o"), core::InputError);
  CHECK_THROWS_AS(check_output_path("", "-o"), core::InputError);
  CHECK_THROWS_AS(check_output_path(folder.path().string() + "/", "-o"), core::InputError);
}

TEST_CASE("a bare name lies in the current folder") { CHECK_NOTHROW(check_output_path("a.png", "-o")); }

TEST_CASE("a pipe, a device and a folder are special, a file and nothing are not") {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(is_special(folder / "pipe"));
  CHECK(is_special("/dev/null"));
  CHECK(is_special(folder.path()));
  CHECK_FALSE(is_special(folder / "file"));
  CHECK_FALSE(is_special(folder / "nothing"));
}

TEST_CASE("the standard output is known by its name, a file beside it is not") {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  CHECK(is_standard_output("/dev/stdout"));
  CHECK_FALSE(is_standard_output(folder / "file"));
  CHECK_FALSE(is_standard_output(folder / "nothing"));
}

TEST_CASE("an output that does not arrive is an error") {
  std::ostringstream good;
  good << "text";
  CHECK_NOTHROW(finish_output(good, "the text"));
  std::ofstream full("/dev/full");
  full << "text";
  CHECK_THROWS_WITH_AS(finish_output(full, "the text"), "the text could not be written to the standard output", core::InputError);
}

TEST_CASE("a name that is as long as names can be will do, and a longer one is said") {
  const TemporaryFolder folder;
  const std::filesystem::path longest = folder / std::string(255, 'a');
  check_output_path(longest, "-o");
  write_whole(longest, "text");
  CHECK(file_text(longest) == "text");
  CHECK_THROWS_WITH_AS(check_output_path(folder / std::string(256, 'a'), "--stats"), doctest::Contains("this name is too long"),
                       core::InputError);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a device that takes nothing is known before anything is written, one that takes all will do") {
  CHECK_THROWS_WITH_AS(check_output_path("/dev/full", "--stats"),
                       "--stats /dev/full: this device takes nothing: No space left on device; give another name",
                       core::InputError);
  CHECK_NOTHROW(check_output_path("/dev/null", "--stats"));
}

TEST_CASE("trying whether a file can be made leaves nothing, and an older one as it was") {
  const TemporaryFolder folder;
  write_text(folder / "a", "old");
  check_output_path(folder / "a", "-o");
  CHECK(file_text(folder / "a") == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a write that fails says so, with the option, and leaves nothing") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(OutputFile(folder / "gone/a.json", {.option = "--stats"}), doctest::Contains("--stats "),
                       core::InputError);
  CHECK_THROWS_AS(write_whole("/dev/full", "text"), core::InputError);
  CHECK(folder.entry_count() == 0);
}

}  // namespace dmpc::apps::output_file_test

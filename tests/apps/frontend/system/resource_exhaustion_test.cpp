#include "apps/frontend/system/resource_exhaustion.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "apps/picture/image_file.h"
#include "tests/support/hostile_files.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::resource_exhaustion_test {

namespace {

[[maybe_unused]] Said end_of(const std::string& line) { return run({"/bin/bash", "-c", line}); }

}  // namespace

TEST_CASE("what has run out is said with what to do about it, and nothing else is a shortage") {
  CHECK_THROWS_WITH_AS(apps::throw_if_short(EMFILE, "no line"),
                       "no line: Too many open files: let dmpc open more files (ulimit -n)", apps::ComputerCapacityError);
  CHECK_THROWS_AS(apps::throw_if_short(EAGAIN, ""), apps::ComputerCapacityError);
  CHECK_NOTHROW(apps::throw_if_short(ENOENT, ""));
  CHECK_NOTHROW(apps::throw_if_short(0, ""));
}

TEST_CASE("a program that did not get ready says what it lacked") {
  for (const std::string complaint : {"terminate called after ...\n  what():  Resource temporarily unavailable\n",
                                      "x: error while loading shared libraries: liby.so: cannot map zero-fill pages",
                                      "liby.so: cannot open shared object file: Error 24", "what(): std::bad_alloc"}) {
    CAPTURE(complaint);
    CHECK_THROWS_AS(apps::throw_if_short(complaint, "x"), apps::ComputerCapacityError);
  }
  CHECK_NOTHROW(apps::throw_if_short("liby.so: cannot open shared object file: No such file or directory", "x"));
  CHECK_NOTHROW(apps::throw_if_short("", "x"));
}

#if !defined(__SANITIZE_ADDRESS__)  // which opens files and starts threads of its own
TEST_CASE("with too few open files a texture is not missing, and the status is 4") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "t.png");
  apps::write_image(folder / "t.png", apps::Image(2, 2));
  for (const std::string files : {"5", "6", "7"}) {
    CAPTURE(files);
    const Said end = end_of("ulimit -n " + files + "; exec " DMPC_PROGRAM " info --missing=plain " + scene);
    CHECK(end.status == 4);
    CHECK_MESSAGE(contains(end.errors, "let dmpc open more files (ulimit -n)"), end.errors);
  }
  const Said end = end_of("ulimit -n 10; exec " DMPC_PROGRAM " render tetra-1 -o " + (folder / "a.png").string());
  CHECK(end.status == 4);
  CHECK(contains(end.errors, "raise the limit (ulimit -n)"));
}

TEST_CASE("readers that may start no process or no thread are this computer's shortage") {
  const TemporaryFolder folder;
  const std::string scene = write_textured_triangle(folder, "t.tga");
  apps::write_image(folder / "t.tga", apps::Image(2, 2));  // which OpenImageIO reads, by threads
  const std::string nobody = "setpriv --reuid=65534 --clear-groups bash -c ";
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  if (::geteuid() != 0 || end_of(nobody + "'exec " DMPC_PROGRAM " list'").status != 0) {
    MESSAGE("left out: it takes a user without processes who may run dmpc");
    return;
  }
  for (const std::string processes : {"2", "6"}) {  // none for the first reader, and none for the second one's threads
    CAPTURE(processes);
    const Said end = end_of(nobody + "'ulimit -u " + processes + "; exec " DMPC_PROGRAM " info --missing=plain " + scene + "'");
    CHECK(end.status == 4);
    CHECK_MESSAGE(contains(end.errors, "let dmpc start more processes and threads"), end.errors);
  }
}
#endif

}  // namespace dmpc::tests::resource_exhaustion_test

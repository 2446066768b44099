// Code that another user has put where dmpc looks for its own: it never runs.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::planted_test {

namespace {

namespace fs = std::filesystem;

constexpr uid_t victim = 65534, stranger = 65533;

/// Where everybody puts files, and somebody a copy of dmpc.
struct SharedFolder {
  TemporaryFolder folder;
  fs::path program = folder / "bin/dmpc", traces = folder / "it_ran";

  SharedFolder() {
    fs::permissions(folder.path(), fs::perms(01777));
    fs::create_directories(program.parent_path());
    fs::copy_file(DMPC_PROGRAM, program);
    write_text(folder / "model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  /// What leaves a trace when it runs, in the stranger's folders if there can be any.
  fs::path plant(const std::string& place) const {
    const fs::path file = folder / place;
    fs::create_directories(file.parent_path());
    write_text(file, "#!/bin/sh\ntouch " + traces.string() + "\n");
    fs::permissions(file, fs::perms(0755));
    if (::geteuid() == 0) {
      for (fs::path owned = file; owned != folder.path(); owned = owned.parent_path()) {
        CHECK(::chown(owned.c_str(), stranger, stranger) == 0);
      }
    }
    return file;
  }
  Said run_as(uid_t user, const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {program};
    if (user != ::geteuid()) {
      command = {"setpriv", "--reuid=" + std::to_string(user), "--clear-groups", program};
    }
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(command);
  }
};

}  // namespace

TEST_CASE("a reader that another user has put where dmpc looks for its own is passed over, and that is said") {
  const SharedFolder shared;
  if (::geteuid() != 0 || shared.run_as(victim, {"--version"}).status != 0) {
    MESSAGE("left out: it takes a superuser, and two more users (setpriv)");
    return;
  }
  const std::string planted = shared.plant("libexec/dmpc/dmpc_mesh_reader");
  shared.plant("apps/dmpc_mesh_reader");
  for (const uid_t user : {victim, ::geteuid()}) {
    const Said said = shared.run_as(user, {"info", shared.folder / "model.obj"});
    CHECK(said.status == 3);
    CHECK_MESSAGE(contains(said.errors, planted + " (which is ignored, since other users may have put it there: "), said.errors);
    CHECK_MESSAGE(contains(said.errors, "it belongs to user " + std::to_string(stranger)), said.errors);
    CHECK_FALSE(fs::exists(shared.traces));
  }
}

TEST_CASE("a reader that everybody may write is passed over") {
  const SharedFolder shared;
  fs::permissions(shared.plant("libexec/dmpc/dmpc_mesh_reader"), fs::perms(0777));
  const Said said = shared.run_as(::geteuid(), {"info", shared.folder / "model.obj"});
  CHECK(said.status == 3);
  CHECK_MESSAGE(contains(said.errors, "which is ignored"), said.errors);
  CHECK_FALSE(fs::exists(shared.traces));
}

TEST_CASE("a module that everybody may write, or that lies where only tests have theirs, is not opened") {
  const SharedFolder shared;
  const fs::path built = fs::path(DMPC_PROGRAM).parent_path(), installed = shared.folder / "lib/dmpc/dmpc_embree.so",
                 beside = shared.folder / "apps/dmpc_embree.so";
  const auto render = [&] {
    return shared.run_as(::geteuid(), {"render", "tetra-1", "--resolution=8x8", "--strategy=replicated", "--quiet",
                                       "--tracer=embree", "-o", shared.folder / "a.png"});
  };
  for (const fs::path& place : {installed, beside}) {
    fs::create_directories(place.parent_path());
  }
  fs::copy_file(built / "dmpc_embree.so", beside);
  CHECK(render().status == 3);
  fs::copy_file(built / "dmpc_embree.so", installed);
  CHECK(render().status == 0);
  fs::permissions(installed.parent_path(), fs::perms(0777));
  const Said said = render();
  CHECK(said.status == 3);
  CHECK_MESSAGE(contains(said.errors, "where it lies: everybody may write to it"), said.errors);
}

TEST_CASE("no plugin of OpenImageIO is loaded from where the environment says, neither to write pictures nor to read them") {
  const TemporaryFolder folder;
  write_text(folder / "planted.imageio.so", "no library");
  const auto loads = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"OIIO_LIBRARY_PATH=" + folder.path().string(), "LD_DEBUG=files",
                                        "LD_DEBUG_OUTPUT=" + (folder / "loaded").string(), DMPC_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    CHECK(run(command).status == 0);
    std::string all;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
      all += entry.path().filename().string().starts_with("loaded") ? file_text(entry.path()) : "";
    }
    return all;
  };
  const std::string picture = folder / "a.bmp";
  const std::string writing = loads({"render", "tetra-1", "--resolution=8x8", "--strategy=replicated", "--quiet", "-o", picture});
  CHECK((contains(writing, "libOpenImageIO") && !contains(writing, "planted")));
  const std::string reading = loads({"compare", picture, picture});
  CHECK((contains(reading, "dmpc_picture_reader") && !contains(reading, "planted")));
}

}  // namespace dmpc::tests::planted_test

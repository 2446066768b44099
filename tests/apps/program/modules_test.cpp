// What a start loads, and modules that are missing, broken or of another build. A copy of the program finds none of ours.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::modules_test {

namespace {

namespace fs = std::filesystem;

const fs::path built = fs::path(DMPC_PROGRAM).parent_path();

/// `surroundings`: options of env, and variables.
Said end_of(const fs::path& program, const std::vector<std::string>& arguments,
            const std::vector<std::string>& surroundings = {}) {
  return run(together({surroundings, {program}, arguments}));
}

/// All that the dynamic loader opens, from the start to the end.
std::string loaded_by(const std::vector<std::string>& arguments) {
  const Said end = end_of(DMPC_PROGRAM, arguments, {"LD_DEBUG=files"});
  CHECK(end.status == 0);
  CHECK(contains(end.errors, "libstdc++"));
  return end.errors;
}

std::vector<std::string> render_of(const fs::path& picture, const std::string& option = "--depth=5") {
  return {"render", "tetra-1", "--resolution=8x8", "--strategy=replicated", "--quiet", option, "-o", picture};
}

/// A render that wants a module.
struct Wanted {
  std::string picture, option, module;
};
std::vector<Wanted> all_that_are_built() {
  std::vector<Wanted> all = {{"a.png", "--tracer=embree", "dmpc_embree.so"}, {"a.png", "--serve", "dmpc_http.so"}};
  if (fs::exists(built / "dmpc_mpi.so")) {  // if there is MPI
    all.push_back({"a.png", "--runner=mpi", "dmpc_mpi.so"});
  }
  return all;
}
const std::vector<Wanted> all_wanted = all_that_are_built();

/// As it is installed, without its modules.
struct Installation {
  TemporaryFolder folder;
  fs::path program = folder / "bin/dmpc", modules = folder / "lib/dmpc";

  Installation() {
    fs::create_directories(program.parent_path());
    fs::create_directories(modules);
    fs::copy_file(DMPC_PROGRAM, program);
  }
  Said render(const Wanted& wanted, const std::vector<std::string>& surroundings = {}) const {
    return end_of(program, render_of(folder / wanted.picture, wanted.option), surroundings);
  }
};

/// "dmpc 0.1.0".
std::string version() {
  const Said said = run_dmpc({"--version"});
  CHECK(said.status == 0);
  return said.output.substr(0, said.output.find('\n'));
}

/// The build that a module says it is of, altered.
void alter_build(const fs::path& module) {
  const std::string beginning = version() + ", ";
  std::string bytes = file_text(module);
  const std::size_t place = bytes.find(beginning);
  REQUIRE(place != std::string::npos);
  char& digit = bytes[place + beginning.size()];
  digit = digit == '0' ? '1' : '0';
  write_text(module, bytes);
}

}  // namespace

TEST_CASE("what renders nothing, and a render to a picture of any kind, load neither OpenImageIO nor Embree nor MPI") {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--version"},
                                             {"info", "tetra-1"},
                                             render_of(folder / "a.exr"),
                                             render_of(folder / "a.tif"),
                                             render_of(folder / "a.jpg"),
                                             render_of(folder / "a.png", "--heatmap=rays:" + (folder / "h.png").string())}) {
    CAPTURE(arguments[0]);
    const std::string loaded = loaded_by(arguments);
    for (const std::string library : {"OpenImageIO", "embree", "libmpi", "httplib", "libssl", "dmpc_"}) {
      CHECK_FALSE_MESSAGE(contains(loaded, library), library);
    }
  }
}

TEST_CASE("Embree as the tracer loads Embree") {
  const TemporaryFolder folder;
  const std::string by_tracer = loaded_by(render_of(folder / "a.png", "--tracer=embree"));
  CHECK((contains(by_tracer, "libembree") && !contains(by_tracer, "OpenImageIO")));
}

TEST_CASE("each program that reads or writes for dmpc is linked with the libraries that it needs, and with no other reader's") {
  const auto libraries_of = [](const std::string& reader) {
    const Said said = run({"LD_TRACE_LOADED_OBJECTS=1", built / reader});
    CHECK(said.status == 0);
    return said.output;
  };
  const std::string of_meshes = libraries_of("dmpc_mesh_reader"), of_pictures = libraries_of("dmpc_picture_reader"),
                    of_plain = libraries_of("dmpc_plain_picture_reader"), of_writer = libraries_of("dmpc_picture_writer");
  CHECK((contains(of_meshes, "libdraco") && !contains(of_meshes, "OpenImageIO") && !contains(of_meshes, "embree")));
  CHECK((contains(of_pictures, "libOpenImageIO") && !contains(of_pictures, "draco") && !contains(of_pictures, "embree")));
  CHECK((contains(of_plain, "libpng") && contains(of_plain, "libjpeg") && !contains(of_plain, "OpenImageIO") &&
         !contains(of_plain, "draco") && !contains(of_plain, "embree")));
  CHECK((contains(of_writer, "libOpenImageIO") && !contains(of_writer, "draco") && !contains(of_writer, "embree")));
}

TEST_CASE("a module that is missing is said with its places, before anything is rendered") {
  const Installation installation;
  for (const Wanted& wanted : all_wanted) {
    CAPTURE(wanted.module);
    const Said end = installation.render(wanted);
    CHECK(end.status == 3);
    CHECK_MESSAGE(contains(end.errors, "the module " + wanted.module + ", with which dmpc "), end.errors);
    CHECK_MESSAGE(contains(end.errors, (installation.modules / wanted.module).string()), end.errors);
    CHECK_MESSAGE(contains(end.errors, "build or install dmpc as a whole"), end.errors);
    CHECK_FALSE(contains(end.errors, "bug"));
    CHECK_FALSE(fs::exists(installation.folder / wanted.picture));
  }
  CHECK(installation.render({"b.png", "--depth=5", ""}).status == 0);
}

TEST_CASE("a picture's writer that is missing is said with its places, before anything is rendered") {
  const Installation installation;
  const Said end = installation.render({"a.tif", "--depth=5", ""});
  CHECK(end.status == 3);
  CHECK_MESSAGE(contains(end.errors, "the program dmpc_picture_writer, which reads or writes files for dmpc,"), end.errors);
  CHECK_MESSAGE(contains(end.errors, (installation.folder / "libexec/dmpc/dmpc_picture_writer").string()), end.errors);
  CHECK_FALSE(fs::exists(installation.folder / "a.tif"));
}

TEST_CASE("a module is looked for at its places alone, not where one happens to be or the environment says") {
  const Installation installation;
  const fs::path elsewhere = installation.folder / "elsewhere";
  fs::create_directories(elsewhere);
  for (const Wanted& wanted : all_wanted) {
    fs::copy_file(built / wanted.module, elsewhere / wanted.module);
    const Said end = installation.render(wanted, {"-C", elsewhere, "LD_LIBRARY_PATH=" + elsewhere.string()});
    CHECK(end.status == 3);
    CHECK_MESSAGE(contains(end.errors, "is in none of its places"), end.errors);
  }
}

TEST_CASE("a module that is broken is said with what the loader has against it") {
  const Installation installation;
  for (const Wanted& wanted : all_wanted) {
    write_text(installation.modules / wanted.module, "no module");
    const Said end = installation.render(wanted);
    CHECK(end.status == 3);
    CHECK_MESSAGE(contains(end.errors, wanted.module + ", with which dmpc "), end.errors);
    CHECK_MESSAGE(contains(end.errors, "cannot be opened: "), end.errors);
  }
}

TEST_CASE("a module of another build is refused, and one of the same is taken") {
  const Installation installation;
  for (const Wanted& wanted : all_wanted) {
    const fs::path module = installation.modules / wanted.module;
    fs::copy_file(built / wanted.module, module);
    CHECK(installation.render(wanted).status == 0);
    alter_build(module);
    const Said end = installation.render(wanted);
    CHECK(end.status == 3);
    CHECK_MESSAGE(contains(end.errors, "is of another build than this program"), end.errors);
  }
}

#if !defined(__SANITIZE_ADDRESS__)  // whose shadow is larger than any memory
TEST_CASE("a picture's writer that this computer has no memory or no threads for is a shortage") {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  const std::string render = "exec " DMPC_PROGRAM " render tetra-1 --resolution=8x8 --nodes=1 -o " + (folder / "a.bmp").string();
  ChildProcess without_memory({"/bin/bash", "-c", "ulimit -v 200000; " + render});
  CHECK(without_memory.status() == 4);
  CHECK_MESSAGE(contains(without_memory.errors(), "let dmpc have more memory"), without_memory.errors());
  const std::vector<std::string> nobody = {"/usr/bin/env", "setpriv", "--reuid=65534", "--clear-groups", "/bin/bash", "-c"};
  const auto as_nobody = [&](const std::string& line) {
    std::vector<std::string> command = nobody;
    command.push_back(line);
    return ChildProcess(command).status();
  };
  if (::geteuid() != 0 || as_nobody("exec " DMPC_PROGRAM " --version") != 0) {
    MESSAGE("left out: it takes a user without processes who may run dmpc");
    return;
  }
  for (const std::string threads : {"2", "3", "5"}) {
    CAPTURE(threads);
    CHECK(as_nobody("ulimit -u " + threads + "; " + render) == 4);
  }
}
#endif

}  // namespace dmpc::tests::modules_test

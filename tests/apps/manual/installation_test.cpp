// dmpc as others get it: installed below some folder, or as a Debian package.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/documents.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::installation_test {

namespace {

namespace fs = std::filesystem;

/// The labs' pages open by a double click: whatever they show is in them, and whatever they lead to lies beside them.
void check_labs(const fs::path& folder) {
  static const std::regex links("(?:href|src)=\"([^\"]*)\"");
  std::size_t pages = 0, bytes = 0;
  for (const fs::directory_entry& page : fs::directory_iterator(folder)) {
    const std::string text = file_text(page.path());
    for (const std::string& link : found_in(text, links)) {
      CHECK_MESSAGE((link.starts_with("data:image/") || fs::exists(folder / link)), page.path(), ": ", link.substr(0, 80));
    }
    CHECK_MESSAGE(contains(text, "default-src 'none'"), page.path());
    CHECK_MESSAGE(!contains(text, "!["), page.path());
    bytes += text.size();
    ++pages;
  }
  CHECK(pages == 15);  // seven labs, their solutions, and the list
  CHECK(bytes < 1'000'000);
}

/// Everything that is to be installed is below `root`.
void check_installed(const fs::path& root) {
  const fs::path share = root / "share";
  for (const fs::path& file : {share / "doc/dmpc/README.md", share / "doc/dmpc/ARCHITECTURE.md", share / "doc/dmpc/copyright",
                               share / "doc/dmpc/apps/balls.png", share / "doc/dmpc/apps/decades.png",
                               share / "dmpc/stats.schema.json", share / "doc/dmpc/apps/balls-heat.png",
                               share / "doc/dmpc/core/README.md", share / "doc/dmpc/apps/lab/study/paper/RESULTS.md",
                               share / "doc/dmpc/apps/scenes.png", share / "doc/dmpc/apps/labs/notebooks/latency.ipynb"}) {
    CHECK_MESSAGE(fs::file_size(file) > 0, file);
  }
  check_labs(share / "doc/dmpc/labs");
  const Said completed = run({"bash", "--norc", "-c",
                              "source '" + (share / "bash-completion/completions/dmpc").string() +
                                  "'; COMP_WORDS=(dmpc ren); COMP_CWORD=1; _dmpc; echo \"${COMPREPLY[@]}\""});
  CHECK(completed.output == "render\n");
  const Said page = run({"env", "LC_ALL=C.UTF-8", "MANPAGER=cat", "man", "--warnings", "-l", share / "man/man1/dmpc.1.gz"});
  CHECK(page.errors.empty());
  CHECK(contains(page.output, "SYNOPSIS"));
}

void check_program(const fs::path& program, const fs::path& folder) {
  CHECK(run({program, "--version"}).output.rfind("dmpc ", 0) == 0);
  for (const std::string name : {"tetra.png", "tetra.tif"}) {  // with the module, and the writer
    const Said rendered = run({program, "render", "tetra-3", "--resolution=16x16", "--strategy=replicated", "--tracer=embree",
                               "--quiet", "-o", folder / name});
    CHECK_MESSAGE(rendered.errors.empty(), rendered.errors);
    CHECK(fs::file_size(folder / name) > 0);
  }
}

/// What a package that lies in `made` says of itself; what is in it is unpacked into a folder of this name.
std::string unpacked_text(const TemporaryFolder& folder, const std::string& package, const std::string& name) {
  const std::string file = "made/" + package;
  const Said unpacked =
      run({"sh", "-c", "cd '" + folder.path().string() + "' && dpkg-deb -f " + file + " && dpkg-deb -x " + file + " " + name});
  REQUIRE_MESSAGE(unpacked.status == 0, unpacked.errors);
  return unpacked.output;
}

/// Every package has its licences and versions, and Debian's own judge of packages finds no fault.
void check_papers(const TemporaryFolder& folder, const std::vector<std::string>& packages) {
  for (const std::string& package : packages) {
    const Said papers = run({"sh", "-c", "cd '" + (folder / "made").string() + "' && dpkg-deb -c " + package + "_*.deb"});
    CHECK_MESSAGE(contains(papers.output, "/usr/share/doc/" + package + "/copyright"), package);
    CHECK_MESSAGE(contains(papers.output, "/usr/share/doc/" + package + "/changelog.gz"), package);
  }
  if (!is_installed("lintian")) {
    MESSAGE("lintian is not installed: it was not asked");
    return;
  }
  const Said judged =
      run({"sh", "-c", "cd '" + (folder / "made").string() + "' && lintian --allow-root --fail-on=error,warning *.deb"});
  CHECK_MESSAGE(judged.status == 0, judged.output);
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path().lexically_relative(folder));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Checks the package beside dmpc's own.
void check_python_package(const TemporaryFolder& folder) {
  const Said unpacked = run({"sh", "-c",
                             "cd '" + folder.path().string() +
                                 "' && dpkg-deb -f made/python3-dmpc_*_all.deb && dpkg-deb -x made/python3-dmpc_*.deb python"});
  REQUIRE_MESSAGE(unpacked.status == 0, unpacked.errors);
  for (const char* const line :
       {"Package: python3-dmpc\n", "Section: python\n", "Architecture: all\n", "Depends: dmpc (= ", "python3-pandas"}) {
    CHECK_MESSAGE(contains(unpacked.output, line), line);
  }
  CHECK(fs::file_size(folder / "python/usr/lib/python3/dist-packages/dmpc/__init__.py") > 0);
  CHECK(fs::file_size(folder / "python/usr/share/doc/python3-dmpc/tour.ipynb") > 0);
  CHECK(fs::exists(folder / "python/usr/lib/python3/dist-packages/dmpc/py.typed"));
  for (const char* const example : {"clock.py", "s4_fifo.py", "speedup.py", "scale.py"}) {
    CHECK(fs::file_size(folder / "python/usr/share/doc/python3-dmpc" / example) > 0);
  }
  CHECK_FALSE(fs::exists(folder / "python/usr/bin"));
}

/// What apps/dmpc has ninja build when it is called for the first time, by such a line: with words in place of the tools that it
/// calls.
std::string targets_of_first_call(const std::string& command) {
  const TemporaryFolder folder;
  const fs::path apps = folder / "root/apps", tools = folder / "tools";
  fs::create_directories(apps);
  fs::create_directories(tools);
  fs::copy_file(DMPC_SOURCE_DIR "/apps/dmpc", apps / "dmpc");
  write_text(apps / "install_packages", "#!/bin/sh\n");
  write_text(tools / "cmake", "#!/bin/sh\n");
  write_text(tools / "ninja", "#!/bin/sh\nshift 4\necho \"$@\" > '" + (folder / "targets").string() + "'\n");
  for (const fs::path& file : {apps / "install_packages", tools / "cmake", tools / "ninja"}) {
    fs::permissions(file, fs::perms::owner_all);
  }
  run({"env", "PATH=" + tools.string() + ":/usr/bin:/bin", "bash", apps / "dmpc", command});
  return file_text(folder / "targets");
}

}  // namespace

TEST_CASE("the first call of apps/dmpc builds the renderer for those who render, and else all that is installed") {
  CHECK(targets_of_first_call("render") == "dmpc\n");
  const std::string targets = targets_of_first_call("study");
  CHECK(targets == "complete\n");
  const Said graph = run({"sh", "-c", "ninja -C '" DMPC_BUILD_DIR "' -t graph " + targets});
  REQUIRE(graph.status == 0);
  const std::string build = DMPC_BUILD_DIR "/";
  std::string script;
  for (const std::string folder :
       {"apps", "apps/main", "apps/modules", "apps/foreign", "apps/manual", "apps/labs", "apps/policy"}) {
    script += file_text(build + folder + "/cmake_install.cmake");
  }
  std::size_t files = 0;
  for (std::size_t at = script.find("FILES \"" + build); at != std::string::npos; at = script.find("FILES \"" + build, at + 1)) {
    const std::size_t begin = at + 7 + build.size();
    const std::string file = script.substr(begin, script.find('"', begin) - begin);
    const bool is_configured = file.starts_with("apps/papers/");
    CHECK_MESSAGE((is_configured || contains(graph.output, "[label=\"" + file + "\"]")), file);
    ++files;
  }
  CHECK(files >= 5);
  CHECK(contains(graph.output, "libdmpc_computer.a"));
}

TEST_CASE("what cmake installs below a folder is complete and works there") {
  const TemporaryFolder folder;
  const fs::path prefix = folder / "a prefix";
  REQUIRE(run({"cmake", "--install", DMPC_BUILD_DIR, "--prefix", prefix}).status == 0);
  check_installed(prefix);
  CHECK(fs::exists(prefix / "share/doc/dmpc/LICENSE"));
  check_program(prefix / "bin/dmpc", folder.path());
}

TEST_CASE("the Debian packages say what they need, MPI and a compiler for one of them each, and what is in them works" *
          doctest::test_suite("slow")) {
  if (!is_installed("dpkg-shlibdeps")) {
    MESSAGE("dpkg-dev is not installed: no package is made");
    return;
  }
  const TemporaryFolder folder;
  const Said packed = run({"cpack", "-G", "DEB", "--config", DMPC_BUILD_DIR "/CPackConfig.cmake", "-B", folder / "made"});
  REQUIRE_MESSAGE(packed.status == 0, packed.errors);
  const std::string all = unpacked_text(folder, "dmpc_*.deb", "all");
  for (const char* const line : {"Package: dmpc\n", "Section: graphics\n", "Suggests: dmpc-mpi, python3-dmpc\n", "libembree3-3",
                                 "libtbb12", "libopenimageio2.4", "libopenexr-3-1-30", "libpng16-16", "libdeflate0", "libgmp10",
                                 "Description: distributed-memory parallel computer", "Emulates N nodes"}) {
    CHECK_MESSAGE(contains(all, line), line);
  }
  CHECK_FALSE(contains(all, "openmpi"));
  check_installed(folder / "all/usr");
  check_program(folder / "all/usr/bin/dmpc", folder.path());
  check_python_package(folder);
  const std::string development = unpacked_text(folder, "libdmpc-dev_*.deb", "development");
  CHECK(contains(development, "Package: libdmpc-dev\n"));
  CHECK(contains(development, "Depends: g++ (>= 4:12)\n"));
  CHECK(fs::exists(folder / "development/usr/include/dmpc/computer.h"));
  const fs::path module = "usr/lib/dmpc/dmpc_mpi.so";
  CHECK_FALSE(fs::exists(folder / "all" / module));
  if (!fs::exists(DMPC_BUILD_DIR "/apps/dmpc_mpi.so")) {
    MESSAGE("MPI is not installed: there is no package dmpc-mpi");
    return;
  }
  const std::string mpi = unpacked_text(folder, "dmpc-mpi_*.deb", "mpi");
  for (const char* const line : {"Package: dmpc-mpi\n", "Depends: dmpc (= ", "libopenmpi3", "Recommends: openmpi-bin\n"}) {
    CHECK_MESSAGE(contains(mpi, line), line);
  }
  const fs::path share = "usr/share", papers = share / "doc/dmpc-mpi";
  CHECK(files_below(folder / "mpi") ==
        std::vector<fs::path>{module, papers / "changelog.gz", papers / "copyright", share / "lintian/overrides/dmpc-mpi"});
  check_papers(folder, {"dmpc", "libdmpc-dev", "python3-dmpc", "dmpc-mpi"});
}

}  // namespace dmpc::tests::installation_test

// What memory reading a mesh file takes, and what bounds it.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "apps/foreign/mesh_reader.h"
#include "apps/foreign/obj/reader.h"
#include "apps/foreign/polygon/off.h"
#include "apps/foreign/polygon/ply.h"
#include "apps/foreign/polygon/stl.h"
#include "apps/formats/reading_memory.h"
#include "tests/fuzz/input_files.h"
#include "tests/support/complaint.h"
#include "tests/support/forked_process.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"
#include "tests/support/text.h"

namespace dmpc::apps::reading_memory_test {

using tests::complaint_of;
using tests::contains;
using tests::repeated;
using tests::TemporaryFolder;

namespace {

/// A bumpy sheet of side x side squares, each of two triangles.
struct Sheet {
  std::uint32_t side;

  std::uint32_t vertex_count() const { return (side + 1) * (side + 1); }
  std::uint32_t triangle_count() const { return 2 * side * side; }
  std::array<float, 3> vertex(std::uint32_t i) const {
    const auto x = static_cast<float>(i % (side + 1)), y = static_cast<float>(i / (side + 1));
    return {x, std::sin(x), y};
  }
  std::array<std::uint32_t, 3> triangle(std::uint32_t i) const {
    const std::uint32_t square = i / 2, corner = square / side * (side + 1) + square % side, other = corner + side + 2;
    return i % 2 == 0 ? std::array{corner, corner + 1, other} : std::array{corner, other, corner + side + 1};
  }
};

using Write = std::function<void(std::ostream&, const Sheet&)>;

void write_text_lists(std::ostream& file, const Sheet& sheet, const char* vertex, const char* face, std::uint32_t first) {
  for (std::uint32_t i = 0; i < sheet.vertex_count(); ++i) {
    const auto [x, y, z] = sheet.vertex(i);
    file << vertex << x << ' ' << y << ' ' << z << '\n';
  }
  for (std::uint32_t i = 0; i < sheet.triangle_count(); ++i) {
    const auto [a, b, c] = sheet.triangle(i);
    file << face << a + first << ' ' << b + first << ' ' << c + first << '\n';
  }
}

std::string ply_head(const Sheet& sheet, const char* format) {
  return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " + std::to_string(sheet.vertex_count()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(sheet.triangle_count()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

void write_ply_binary(std::ostream& file, const Sheet& sheet) {
  file << ply_head(sheet, "binary_little_endian");
  for (std::uint32_t i = 0; i < sheet.vertex_count(); ++i) {
    file << tests::bytes_of(sheet.vertex(i));
  }
  for (std::uint32_t i = 0; i < sheet.triangle_count(); ++i) {
    file << '\3' << tests::bytes_of(sheet.triangle(i));
  }
}

void write_stl(std::ostream& file, const Sheet& sheet) {
  file << std::string(80, ' ') << tests::bytes_of(sheet.triangle_count());
  for (std::uint32_t i = 0; i < sheet.triangle_count(); ++i) {
    file << std::string(12, '\0');
    for (const std::uint32_t corner : sheet.triangle(i)) {
      file << tests::bytes_of(sheet.vertex(corner));
    }
    file << std::string(2, '\0');
  }
}

const std::vector<std::pair<std::string, Write>>& formats() {
  static const std::vector<std::pair<std::string, Write>> all = {
      {"a.obj", [](auto& file, const Sheet& sheet) { write_text_lists(file, sheet, "v ", "f ", 1); }},
      {"text.ply",
       [](auto& file, const Sheet& sheet) {
         file << ply_head(sheet, "ascii");
         write_text_lists(file, sheet, "", "3 ", 0);
       }},
      {"binary.ply", write_ply_binary},
      {"a.stl", write_stl},
      {"a.off", [](auto& file, const Sheet& sheet) {
         file << "OFF\n" << sheet.vertex_count() << ' ' << sheet.triangle_count() << " 0\n";
         write_text_lists(file, sheet, "", "3 ", 0);
       }}};
  return all;
}

/// Bytes of this process, by their name in /proc.
std::uint64_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) {
      return 1024 * std::stoull(line.substr(name.size() + 1));
    }
  }
  return 0;
}

/// The file that a process of its own reads, and its format.
std::string path_to_read, format_to_read;

/// Whether reading takes, together with its reader and without a database, at most twice what is estimated with one. Not asked
/// with sanitizers, which take memory of their own.
[[maybe_unused]] bool takes_twice_at_most() {
  ::open("/dev/null", O_WRONLY);  // as stderr, which a forked process has not
  const std::uint64_t before = status_bytes("VmRSS");
  read_mesh_file(path_to_read);
  rusage readers{};
  ::getrusage(RUSAGE_CHILDREN, &readers);
  const std::uint64_t taken = status_bytes("VmHWM") - before + 1024 * static_cast<std::uint64_t>(readers.ru_maxrss);
  return taken <=
         2 * estimated_reading_bytes(format_to_read, std::filesystem::file_size(path_to_read)) + (std::uint64_t{64} << 20U);
}

/// One file, and a bound of memory. `text` outlives it.
fuzz::InputFiles bounded_file(const std::string& name, const std::string& text, std::uint64_t memory_bytes) {
  return {name, std::as_bytes(std::span(text)), memory_bytes};
}

std::string refusal(const std::string& name, const std::string& text, std::uint64_t memory_bytes) {
  fuzz::InputFiles file = bounded_file(name, text, memory_bytes);
  return complaint_of<core::CapacityError>([&] { read_mesh(name, {}, file); });
}

void make_sparse(const std::filesystem::path& path, const std::string& head, std::uint64_t bytes) {
  std::ofstream(path) << head;
  std::filesystem::resize_file(path, bytes);
}

std::string refusal_of(const std::string& path) {
  return complaint_of<core::CapacityError>([&] { read_mesh_file(path); });
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("reading takes no more than twice the memory that is estimated, and 64 MiB") {
  const TemporaryFolder folder;
  for (const auto& [name, write] : formats()) {
    CAPTURE(name);
    path_to_read = folder / name;
    std::ofstream file(path_to_read);
    write(file, Sheet{500});
    file.close();
    format_to_read = name.substr(name.size() - 3);
    std::transform(format_to_read.begin(), format_to_read.end(), format_to_read.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    CHECK(tests::ForkedProcess([] { return takes_twice_at_most() ? 0 : 1; }).status() == 0);
  }
}
#endif

TEST_CASE("a file whose triangles take more memory than a scene may is refused before they are made") {
  const std::map<std::string, PlacedFile (*)(const std::string&, SceneFiles&)> readers = {
      {"obj", read_obj}, {"ply", read_ply}, {"stl", read_stl}, {"off", read_off}};
  for (const auto& [name, write] : formats()) {
    CAPTURE(name);
    std::ostringstream file;
    write(file, Sheet{10});
    const std::string text = file.str();
    const auto read = readers.at(name.substr(name.size() - 3));
    fuzz::InputFiles enough = bounded_file(name, text, 1U << 20U), little = bounded_file(name, text, 10'000);
    CHECK_NOTHROW(read(name, enough));
    CHECK_THROWS_WITH_AS(read(name, little), doctest::Contains("triangles so far take at least"), core::CapacityError);
  }
  const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
  const std::string text = "solid\n" + facet + facet + "endsolid\n";
  CHECK(contains(refusal("a.stl", text, 150), "its 2 triangles so far"));
  const std::string quads = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 2 1\n";
  CHECK(contains(refusal("a.obj", quads, 150), "line 5: its 2 triangles so far"));
}

TEST_CASE("a total of all shapes so far, and of all places of instances, is refused at the line where memory would end") {
  const std::string world = "WorldBegin\n", cylinder = "Shape \"cylinder\"\n";
  const auto pbrt = [&](const std::string& text, std::uint64_t bytes) { return refusal("a.pbrt", world + text, bytes); };
  CHECK(pbrt(repeated(3, cylinder), 1U << 20U).empty());
  CHECK(contains(pbrt(repeated(3, cylinder), 20'000), "a.pbrt:3:1: its 256 triangles so far take at least"));
  const std::string object = "ObjectBegin \"a\"\n" + cylinder + "ObjectEnd\n", instance = "ObjectInstance \"a\"\n";
  CHECK(contains(pbrt(object + repeated(3, instance), 20'000), "a.pbrt:6:1: its 256 triangles so far"));
  CHECK(contains(pbrt(instance + instance + object, 20'000), "a.pbrt:3:1: its 256 triangles so far"));
  CHECK(contains(pbrt(repeated(99, instance), 10'000), "its 0 triangles so far"));  // geometry that is still to come
  CHECK(pbrt(repeated(9, "Shape \"sphere\"\n"), 10'000).empty());
  const std::string flat = "Scale 1 1 2\n", ball = "Shape \"sphere\"\n";
  CHECK(contains(pbrt(flat + ball + ball, 500'000), "a.pbrt:4:1: its 8,192 triangles so far"));
}

TEST_CASE("what a few words become is asked for before it is made") {
  const std::string world = "WorldBegin\n", square = " \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"integer indices\" [";
  const auto pbrt = [&](const std::string& text, std::uint64_t bytes) { return refusal("a.pbrt", world + text, bytes); };
  CHECK(contains(pbrt("Shape \"bilinearmesh\"" + square + repeated(100, "0 1 2 3 ") + "]", 200'000), "a.pbrt:2:1: its 12,800 "));
  const std::string loop = "Shape \"loopsubdiv\" \"integer levels\" 9" + square + "0 1 2]";
  CHECK(contains(pbrt(loop, 10'000'000), "a.pbrt:2:1: its 262,144 triangles so far"));
}

TEST_CASE("places of glTF's meshes are asked for before they are made, and so are zeros") {
  const std::string node = R"({"mesh":0})",
                    instances = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}})";
  const auto gltf = [](const std::string& node_of_all, const std::string& count, std::uint64_t bytes) {
    const std::string zeros = R"({"componentType":5126,"type":"VEC3","count":)";
    return refusal("a.gltf",
                   R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1,2]}],"nodes":[)" + node_of_all + "," + node_of_all +
                       "," + node_of_all + R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[)" +
                       zeros + "3}," + zeros + count + "}]}",
                   bytes);
  };
  CHECK(contains(gltf(node, "3", 400), "node 'nodes[1]': its 2 triangles so far take at least"));
  CHECK(contains(gltf(instances, "1000", 50'000), "EXT_mesh_gpu_instancing: its 1 triangles so far take at least"));
  CHECK(contains(gltf(instances, "9007199254740991", 1'000'000'000), "accessors[1]: its 1 triangles so far take at least"));
}

TEST_CASE("more triangles than a database has room for are refused before the file is read, with both figures") {
  const TemporaryFolder folder;
  constexpr std::uint32_t facets = 400'000'000;
  const std::string expected = ": its 400,000,000 triangles need a database of at least 16.4 GiB, and one has 16 GiB at most";
  make_sparse(folder / "a.stl", std::string(80, ' ') + tests::bytes_of(facets), 84 + std::uint64_t{50} * facets);
  CHECK(contains(refusal_of(folder / "a.stl"), "a.stl" + expected));
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 400000000\nproperty list uchar int vertex_indices\nend_header\n";
  make_sparse(folder / "a.ply", head, head.size() + 36 + std::uint64_t{13} * facets);
  CHECK(contains(refusal_of(folder / "a.ply"), "a.ply" + expected));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadow is larger than any limit
TEST_CASE("a reader whose memory ends names the bound that held, and not the addresses of a large file") {
  const TemporaryFolder folder;
  constexpr std::uint32_t facets = 200'000'000;
  path_to_read = folder / "a.stl";
  make_sparse(path_to_read, std::string(80, ' ') + tests::bytes_of(facets), 84 + std::uint64_t{50} * facets);
  const tests::ForkedProcess limited([] {
    ::open("/dev/null", O_WRONLY);  // or what is said of memory would go to the reader
    const rlimit limit{std::uint64_t{1} << 30U, RLIM_INFINITY};
    ::setrlimit(RLIMIT_DATA, &limit);
    return contains(refusal_of(path_to_read), "the reader of STL files took more than the 1024 MiB of memory") ? 0 : 1;
  });
  CHECK(limited.status() == 0);
}
#endif

TEST_CASE("a file that has no room for what it says is cut short, and not too large") {
  const std::string message = tests::mesh_refusal("a.stl", std::string(80, ' ') + tests::bytes_of(std::uint32_t{4'000'000'000}));
  CHECK(contains(message, "the file is cut short"));
}

TEST_CASE("a database has room for as many triangles as its blocks can hold, and for no more") {
  constexpr std::uint64_t most = (std::uint64_t{16} << 30U) / 44;
  CHECK_NOTHROW(check_database(most));
  CHECK_THROWS_AS(check_database(most + 1), core::CapacityError);
}

}  // namespace dmpc::apps::reading_memory_test

// What reading a mesh file takes, said before it is read.

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "apps/foreign/obj/counts.h"
#include "apps/formats/mesh_counts.h"
#include "tests/support/forked_process.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"

namespace dmpc::apps::reading_forecast_test {

using tests::contains;
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

/// The file that a process of its own reads.
std::string path_to_read;

/// How many MiB more reading takes, together with its reader, than was said and 64 MiB; at most 200. Not asked with sanitizers.
[[maybe_unused]] int excess_mebibytes() {
  const std::uint64_t before = status_bytes("VmRSS");
  const MeshFile mesh = read_mesh_file(path_to_read);
  rusage readers{};
  ::getrusage(RUSAGE_CHILDREN, &readers);
  const std::uint64_t taken = status_bytes("VmHWM") - before + 1024 * static_cast<std::uint64_t>(readers.ru_maxrss);
  const std::uint64_t said = mesh.forecast->reader_bytes + mesh.forecast->transfer_bytes + (std::uint64_t{64} << 20U);
  return taken <= said ? 0 : static_cast<int>(std::min<std::uint64_t>((taken - said) / (1U << 20U) + 1, 200));
}

void make_sparse(const std::filesystem::path& path, const std::string& head, std::uint64_t bytes) {
  std::ofstream(path) << head;
  std::filesystem::resize_file(path, bytes);
}

std::string refusal_of(const std::string& path) {
  try {
    read_mesh_file(path);
  } catch (const core::RoomError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__)  // which takes memory of its own
TEST_CASE("reading takes no more memory than was said before, and 64 MiB") {
  const TemporaryFolder folder;
  for (const auto& [name, write] : formats()) {
    CAPTURE(name);
    path_to_read = folder / name;
    std::ofstream file(path_to_read);
    write(file, Sheet{500});
    file.close();
    CHECK(tests::ForkedProcess([] { return excess_mebibytes(); }).status() == 0);
  }
}
#endif

TEST_CASE("a forecast has each face and corner of a file, in text and in binary") {
  const Sheet sheet{10};
  for (const auto& [name, write] : formats()) {
    CAPTURE(name);
    std::ostringstream text;
    write(text, sheet);
    const MeshFile mesh = tests::read_mesh(name, text.str());
    REQUIRE(mesh.forecast);
    const bool shares = name != "a.stl";
    const MeshCounts expected{.vertices = shares ? sheet.vertex_count() : 3 * sheet.triangle_count(),
                              .faces = sheet.triangle_count(),
                              .corners = 3 * sheet.triangle_count()};
    CHECK(mesh.forecast->transfer_bytes == forecast_of(expected).transfer_bytes);
    CHECK(mesh.forecast->reader_bytes >= forecast_of(expected).reader_bytes);
  }
}

TEST_CASE("of what stands in several places a forecast has all of them, as nodes or as instances of one") {
  const auto forecast_with = [](int nodes, int instances) {
    tests::GltfDocument document;
    const std::size_t positions = document.accessor(document.view(tests::bytes_of(tests::triangle_corners)), 5126, 3, "VEC3");
    const std::string moves(12 * static_cast<std::size_t>(instances), '\0');
    const std::size_t places = document.accessor(document.view(moves), 5126, static_cast<std::size_t>(instances), R"(VEC3)");
    const std::string node =
        R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" + std::to_string(places) + "}}}";
    document.node = node;
    for (int i = 1; i < nodes; ++i) {
      document.node += (i == 1 ? R"(,"children":[1]},)" : "},") + node;
    }
    document.node += "}";
    return *tests::read_mesh("a.gltf", document.text(R"({"attributes":{"POSITION":)" + std::to_string(positions) + "}}"))
                .forecast;
  };
  const MeshCounts thousand{.vertices = 3000, .faces = 1000, .corners = 3000, .has_instances = true};
  CHECK(forecast_with(1, 1000).transfer_bytes == forecast_of(thousand).transfer_bytes);
  CHECK(forecast_with(2, 500).transfer_bytes == forecast_of(thousand).transfer_bytes);
  const MeshCounts one{.vertices = 3, .faces = 1, .corners = 3};
  CHECK(forecast_with(1, 1).building_bytes == forecast_of(one).building_bytes);
}

TEST_CASE("statements of OBJ count wherever they stand in a line, and on lines that go on") {
  const MeshCounts counts =
      obj::counts_of("v 0 0 0\n\tv 1 0 0 1 0 0\r\nv 0 1 0 1 1 1\nvt 0 0\nf 1/1 2/1 \\\n 3/1 1/1\r\n  f 1 2 3\n#f 1");
  CHECK(counts.vertices == 3);
  CHECK(counts.faces == 2);
  CHECK(counts.corners == 4 + 3 + 1);  // the backslash may be one
  CHECK(counts.has_places);
  CHECK(counts.has_colors);
  CHECK_FALSE(counts.has_normals);
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
  CHECK_THROWS_AS(check_database(most + 1), core::RoomError);
}

}  // namespace dmpc::apps::reading_forecast_test

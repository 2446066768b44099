#include "apps/foreign/polygon/stl_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/polygon/indexed_mesh.h"
#include "apps/foreign/polygon/text_words.h"

namespace dmpc::apps {
namespace {

/// `b` in small letters.
bool is_same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char letter, char other) { return std::tolower(letter) == other; });
}

class StlTextReader {
 public:
  StlTextReader(std::string_view text, ReadingProgress& progress) : text_(text), words_(text), progress_(progress) {}

  PlacedFile read();

 private:
  void read_solid(PlacedFile& file);
  void read_facet(IndexedMesh& mesh);
  /// The next word, which has to be this one.
  void take(std::string_view word) { expect(words_.next(), word); }
  void expect(std::string_view found, std::string_view word) const;

  std::string_view text_;
  TextWords words_;
  ReadingProgress& progress_;
  std::size_t solids_ = 0;
  std::uint64_t facets_ = 0;
};

PlacedFile StlTextReader::read() {
  PlacedFile file{.materials = {{plain_material(), {}}}};
  for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
    if (solids_ > 0 && !is_same(word, "solid")) {
      file.notes.emplace_back("what follows the last solid is left out");
      break;
    }
    expect(word, "solid");
    read_solid(file);
  }
  return file;
}

void StlTextReader::read_solid(PlacedFile& file) {
  const std::string name = clipped(words_.rest_of_line(), 100);
  IndexedMesh mesh{.name = "solid " + std::to_string(++solids_) + (name.empty() ? "" : " '" + name + "'")};
  for (std::string_view word = words_.next(); !is_same(word, "endsolid"); word = words_.next()) {
    if (word.empty()) {
      words_.fail("the file is cut short: it does not end with 'endsolid'");
    }
    expect(word, "facet");
    progress_.check_triangles(++facets_);
    read_facet(mesh);
    progress_.show(words_.position());
  }
  words_.rest_of_line();
  add_meshes(std::move(mesh), file);
}

void StlTextReader::read_facet(IndexedMesh& mesh) {
  take("normal");
  for (int i = 0; i < 3; ++i) {
    words_.next();  // be it -nan(ind)
  }
  take("outer");
  take("loop");
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 3; ++i) {
    take("vertex");
    const double x = words_.number("a coordinate"), y = words_.number("a coordinate"), z = words_.number("a coordinate");
    mesh.vertices.push_back({x, y, z});
  }
  take("endloop");
  take("endfacet");
  mesh.add_face(std::array{first, first + 1, first + 2});
}

void StlTextReader::expect(std::string_view found, std::string_view word) const {
  if (!is_same(found, word)) {
    words_.fail(found.empty() ? "the file is cut short: it ends where '" + std::string(word) + "' is expected"
                              : "found '" + clipped(found, 40) + "', expected '" + std::string(word) + "'");
  }
}

}  // namespace

PlacedFile read_stl_text(std::string_view text, ReadingProgress& progress) { return StlTextReader(text, progress).read(); }

}  // namespace dmpc::apps

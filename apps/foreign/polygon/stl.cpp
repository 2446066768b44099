#include "apps/foreign/polygon/stl.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/polygon/face_looks.h"
#include "apps/foreign/polygon/reading_progress.h"
#include "apps/foreign/polygon/stl_binary.h"
#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/system/byte_order_mark.h"

namespace dmpc::apps {
namespace {

/// `b` is in lower case.
bool is_same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char letter, char other) { return std::tolower(letter) == other; });
}

/// Keywords may be in any case and on any lines, except a solid's name, which ends its line.
class StlTextReader {
 public:
  StlTextReader(std::string_view text, ReadingProgress& progress)
      : text_(text), words_(text, 1, without_remarks), progress_(progress) {}

  PlacedFile read() {
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

 private:
  void read_solid(PlacedFile& file) {
    const std::string name = clipped(words_.rest_of_line(), 100);
    PolygonMesh mesh{.name = "solid " + std::to_string(++solids_) + (name.empty() ? "" : " '" + name + "'")};
    for (std::string_view word = words_.next(); !is_same(word, "endsolid"); word = words_.next()) {
      expect(word, "facet");
      progress_.ask_for_triangles(++facets_);
      read_facet(mesh);
      progress_.show(words_.position());
    }
    words_.rest_of_line();
    add_mesh(std::move(mesh), {}, file);
  }

  void read_facet(PolygonMesh& mesh) {
    take("normal");
    for (int i = 0; i < 3; ++i) {
      words_.next();  // including -nan(ind)
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
    add_face(std::array{first, first + 1, first + 2}, mesh);
  }

  /// Requires the next word to be this one.
  void take(std::string_view word) { expect(words_.next(), word); }

  void expect(std::string_view found, std::string_view word) const {
    if (!is_same(found, word)) {
      words_.fail_at(found, "'" + std::string(word) + "'");
    }
  }

  std::string_view text_;
  LineWords words_;
  ReadingProgress& progress_;
  std::size_t solids_ = 0;
  std::uint64_t facets_ = 0;
};

bool begins_with_solid(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return in_small_letters(text.substr(0, 5)) == "solid";
}

/// Requires that zero bytes occur only after the end of the text.
bool is_text(std::string_view file) {
  const std::string_view text = file.substr(0, file.find('\0'));
  const bool is_whole = text.size() == file.size() || text.find("endsolid") != std::string_view::npos;
  return begins_with_solid(without_mark(file)) && is_whole && !is_whole_stl_binary(file);
}

}  // namespace

PlacedFile read_stl(const std::string& path, SceneFiles& files) {
  return read_whole(path, files, [](std::string_view file, ReadingProgress& progress) {
    return is_text(file) ? StlTextReader(without_mark(file), progress).read() : read_stl_binary(file, progress);
  });
}

}  // namespace dmpc::apps

#include "apps/foreign/polygon/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/polygon/face_looks.h"
#include "apps/foreign/polygon/reading_progress.h"
#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/system/byte_order_mark.h"
#include "core/base/expect.h"

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

constexpr std::size_t header_bytes = 80, facet_bytes = 50, facets_begin = header_bytes + sizeof(std::uint32_t);
/// The bits of a colour channel of an attribute.
constexpr unsigned mask = 31;

/// Reads a little-endian value.
template <class T>
T value_at(std::string_view file, std::size_t place) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, file.data() + place, sizeof value);
  return value;
}

/// The format: a header of 80 bytes, a count, and 50 bytes per facet, of which the last 2 are its attribute. A header with
/// COLOR= (Magics) has the colour of all facets whose attribute is 0 or has its highest bit set; other facets have their own
/// colour: 5 bits each of red, from the lowest bit, green and blue. Without COLOR=, attributes with the highest bit set are
/// colours (VisCAM): 5 bits each of blue, green and red. Throws core::InputError.
class StlBinaryReader {
 public:
  StlBinaryReader(std::string_view file, ReadingProgress& progress)
      : file_(file), progress_(progress), whole_color_(color_in(file.substr(0, header_bytes))) {}

  PlacedFile read() {
    const std::size_t count = count_facets();
    progress_.ask_for_triangles(count);
    mesh_.vertices.reserve(3 * count);
    mesh_.faces.corners.reserve(3 * count);
    mesh_.faces.ends.reserve(count);
    for (std::size_t facet = 0; facet < count; ++facet) {
      read_facet(facet);
      progress_.show(facet * facet_bytes);
    }
    core::Material material = plain_material();
    if (coloured_ > 0) {
      notes_.push_back("facets that have the colour of their attribute: " + grouped(coloured_));
      make_linear(looks_.colors, count, mask, whole_color_.value_or(colour_of_none));
      material.color = {1, 1, 1};
    } else if (whole_color_) {
      material.color = *whole_color_;
    }
    PlacedFile file{.materials = {{material, {}}}, .notes = std::move(notes_), .coordinate_rounding = 0x1p-25};
    add_mesh(std::move(mesh_), std::move(looks_), file);
    return file;
  }

 private:
  /// Returns the colour that the header gives to the whole object.
  std::optional<Color> color_in(std::string_view header) {
    constexpr std::string_view key = "COLOR=";
    constexpr std::size_t channels = 4;
    const std::size_t place = header.find(key);
    if (place == std::string_view::npos || place + key.size() + channels > header.size()) {
      return std::nullopt;
    }
    if (header.find("MATERIAL=") != std::string_view::npos) {
      notes_.emplace_back("the header's MATERIAL=, which is not shown");
    }
    const auto channel = [&](std::size_t i) {
      return static_cast<double>(static_cast<std::uint8_t>(header[place + key.size() + i]));
    };
    return linear_color({channel(0), channel(1), channel(2)}, 255);
  }

  std::size_t count_facets() {
    if (file_.size() < facets_begin) {
      throw core::InputError("is no STL: it neither begins with 'solid' nor has the 84 bytes with which binary ones begin");
    }
    const std::size_t count = value_at<std::uint32_t>(file_, header_bytes), bytes = file_.size() - facets_begin;
    const std::size_t room = bytes / facet_bytes;
    if (room < count) {
      throw core::InputError("the file is cut short: it has room for " + std::to_string(room) + " facets, and says that it has " +
                             std::to_string(count));
    }
    if (count == 0 && room > 0 && bytes % facet_bytes == 0) {
      notes_.push_back("says that it has no facets; by its length it has these: " + grouped(std::uint64_t{room}));
      return room;
    }
    if (bytes > count * facet_bytes) {
      notes_.push_back("bytes behind the last facet, which are not looked at: " +
                       grouped(std::uint64_t{bytes - count * facet_bytes}));
    }
    return count;
  }

  void read_facet(std::size_t facet) {
    constexpr std::size_t normal_bytes = 12;
    const std::size_t begin = facets_begin + facet * facet_bytes;
    const auto corners = value_at<std::array<std::array<float, 3>, 3>>(file_, begin + normal_bytes);
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const auto& [x, y, z] : corners) {
      mesh_.vertices.push_back({double{x}, double{y}, double{z}});
    }
    add_face(std::array{first, first + 1, first + 2}, mesh_);
    if (const auto color = color_of(value_at<std::uint16_t>(file_, begin + facet_bytes - sizeof(std::uint16_t)))) {
      ++coloured_;
      set_last(looks_.colors, mesh_.faces.ends.size(), *color);
    }
  }

  std::optional<Color> color_of(std::uint16_t attribute) const {
    constexpr unsigned mark = 0x8000U;
    const bool is_own = whole_color_ ? attribute != 0 && (attribute & mark) == 0 : (attribute & mark) != 0;
    if (!is_own) {
      return std::nullopt;
    }
    const double low = attribute & mask, middle = attribute >> 5U & mask, high = attribute >> 10U & mask;
    return whole_color_ ? Color{low, middle, high} : Color{high, middle, low};
  }

  std::string_view file_;
  ReadingProgress& progress_;
  std::vector<std::string> notes_;
  std::optional<Color> whole_color_;
  PolygonMesh mesh_{.name = "the solid", .is_by_vertex = true};
  FaceLooks looks_;
  std::uint64_t coloured_ = 0;
};

/// Returns whether the file is as long as its facet count implies.
bool is_whole_stl_binary(std::string_view file) {
  return file.size() >= facets_begin &&
         file.size() == facets_begin + facet_bytes * std::size_t{value_at<std::uint32_t>(file, header_bytes)};
}

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
    return is_text(file) ? StlTextReader(without_mark(file), progress).read() : StlBinaryReader(file, progress).read();
  });
}

}  // namespace dmpc::apps

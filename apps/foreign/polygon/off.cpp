#include "apps/foreign/polygon/off.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/polygon/face_looks.h"
#include "apps/foreign/polygon/reading_progress.h"
#include "apps/foreign/text/line_words.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/system/byte_order_mark.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, ReadingProgress& progress)
      : text_(text), words_(text, 1, {}), progress_(progress), bytes_(text.size()) {}

  PlacedFile read() {
    read_header();
    progress_.ask_for_triangles(std::min(faces_, room()));
    mesh_.vertices.reserve(std::min(vertices_, room()));
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      read_vertex(i);
      progress_.show(words_.position());
    }
    mesh_.faces.ends.reserve(std::min(faces_, room()));
    for (std::uint64_t i = 0; i < faces_; ++i) {
      read_face(i);
      progress_.show(words_.position());
    }
    PlacedFile file;
    const auto note = [&file](const std::string& what, std::uint64_t count) { note_count(file.notes, what, count); };
    note("points and lines left out", thin_);
    note("colours by their number in a map, which are not shown", from_map_);
    note("colours whose alpha is not shown", see_through_);
    note("channels of colours that are no numbers, shown as 0 (the first in line " + std::to_string(first_stray_) + ")", strays_);
    const std::string_view rest = words_.next();
    note("bytes behind the last face, which are not looked at", rest.empty() ? 0 : bytes_ - words_.position() + rest.size());
    looks_.give_way_to(mesh_, file.notes);
    make_linear(mesh_.colors, mesh_.vertices.size(), full_light(mesh_.colors));
    make_linear(looks_.colors, mesh_.faces.ends.size(), full_light(looks_.colors));
    const bool has_colors = !mesh_.colors.empty() || !looks_.colors.empty();
    file.materials = {{has_colors ? plain_material({1, 1, 1}) : plain_material(), {}}};
    add_mesh(std::move(mesh_), std::move(looks_), file);
    return file;
  }

 private:
  void read_header() {
    std::string_view word = words_.next();
    const std::size_t end = std::min(word.find("OFF"), word.size()) + 3;
    const bool has_count = end < word.size() && decimal_number(word.substr(end));  // "OFF490 518 0", as in ModelNet
    if ((end == word.size() || has_count) && end <= std::string_view("STCN4nOFF").size()) {
      read_kind(word.substr(0, end));
      word = has_count ? word.substr(end) : words_.next();
      if (word == "BINARY") {
        words_.fail("OFF in binary is not read; write it as text");
      }
    } else if (!decimal_number(word)) {
      words_.fail_at(word, "OFF, perhaps with ST, C or N before it, or the number of vertices");
    }
    read_counts(word);
  }

  /// ST, C, N, 4 and n precede OFF in this order.
  void read_kind(std::string_view word) {
    const std::string_view whole = word;
    const auto take = [&word](std::string_view part) {
      const bool is_there = word.starts_with(part);
      word.remove_prefix(is_there ? part.size() : 0);
      return is_there;
    };
    has_places_ = take("ST");
    has_colors_ = take("C");
    has_normals_ = take("N");
    const bool is_other = take("4") || take("n");
    if (is_other) {
      words_.fail("'" + std::string(whole) +
                  "' has vertices of other than three coordinates, which are not read; expected OFF of three");
    }
  }

  /// The number of edges is optional.
  void read_counts(std::string_view first) {
    vertices_ = count_of(first, "the number of vertices");
    faces_ = count_of(words_.next(), "the number of faces");
    if (const std::string_view edges = words_.next_in_line(); !edges.empty()) {
      count_of(edges, "the number of edges");
    }
    if (const std::string_view more = words_.next_in_line(); !more.empty()) {
      words_.fail_at(more, "no more than the numbers of vertices, faces and edges in a line");
    }
    if (vertices_ > room() || faces_ > room()) {
      words_.fail("the file is cut short: it says that it has " + grouped(vertices_) + " vertices and " + grouped(faces_) +
                  " faces, for which it has too few bytes");
    }
  }

  std::uint64_t count_of(std::string_view word, const char* what) const {
    const auto count = decimal_number(word);
    if (!count || !(*count >= 0 && *count < 0x1p53 && std::floor(*count) >= *count)) {
      words_.fail_at(word, what);
    }
    return static_cast<std::uint64_t>(*count);
  }

  double number_of(std::string_view word, const char* what) const {
    const auto number = decimal_number(word);
    if (!number) {
      words_.fail_at(word, what);
    }
    return *number;
  }

  /// Also accepts a word for NaN, which gives NaN.
  double number_or_none(std::string_view word, const char* what) const {
    return is_no_number(word) ? std::numeric_limits<double>::quiet_NaN() : number_of(word, what);
  }

  /// The first numbers of a vertex may extend over several lines.
  void read_vertex(std::uint64_t number) {
    numbers_.clear();
    const std::size_t own = has_normals_ ? 6 : 3, places = has_places_ ? 2 : 0;
    while (numbers_.size() < own) {
      const std::string_view word = words_.next();
      if (word.empty()) {
        words_.fail("the file is cut short: it ends within vertex " + std::to_string(number) + " of " +
                    std::to_string(vertices_));
      }
      numbers_.push_back(number_or_none(word, "a coordinate"));
    }
    mesh_.vertices.push_back({numbers_[0], numbers_[1], numbers_[2]});
    if (has_normals_) {
      mesh_.normals.push_back({numbers_[3], numbers_[4], numbers_[5]});
    }
    read_rest_of_line();
    if (numbers_.size() < own + places) {
      words_.fail("vertex " + std::to_string(number) + " has no texture coordinates, which ST promises");
    }
    numbers_.resize(numbers_.size() - places);
    if (const auto color = off_color(own)) {
      set_last(mesh_.colors, mesh_.vertices.size(), *color);
    }
  }

  void read_face(std::uint64_t number) {
    const std::string_view word = words_.next();
    if (word.empty()) {
      words_.fail("the file is cut short: it ends before face " + std::to_string(number) + " of " + std::to_string(faces_));
    }
    const std::uint64_t count = count_of(word, "the number of a face's corners");
    corners_.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      corners_.push_back(read_corner(number));
    }
    numbers_.clear();
    read_rest_of_line();
    if (count < 3) {
      ++thin_;
      return;
    }
    add_face(corners_, mesh_);
    progress_.ask(size_of(mesh_));
    if (const auto color = off_color(0)) {
      set_last(looks_.colors, mesh_.faces.ends.size(), *color);
    }
  }

  std::uint32_t read_corner(std::uint64_t face) {
    const std::string_view word = words_.next();
    if (word.empty()) {
      words_.fail("the file is cut short: it ends within face " + std::to_string(face) + " of " + std::to_string(faces_));
    }
    const double index = number_of(word, "the number of a vertex");
    if (!(index >= 0 && index < static_cast<double>(vertices_) && std::floor(index) >= index)) {
      words_.fail("face " + std::to_string(face) + " has a vertex that does not exist, " + clipped(word, 40) + ": there are " +
                  std::to_string(vertices_) + "; correct the file");
    }
    return static_cast<std::uint32_t>(index);
  }

  /// Returns the colour from the numbers of a line from index `begin` on.
  std::optional<Color> off_color(std::size_t begin) {
    const std::size_t count = numbers_.size() - begin;
    if (count == 0) {
      return std::nullopt;
    }
    if (count == 1) {
      ++from_map_;
      return std::nullopt;
    }
    if (count != 3 && count != 4) {
      words_.fail("there are " + std::to_string(count) + " numbers of a colour; expected 3 or 4");
    }
    const auto from_zero = [&](std::size_t i) {
      if (std::isnan(numbers_[begin + i])) {
        first_stray_ = strays_++ == 0 ? words_.line() : first_stray_;
        return 0.0;
      }
      if (!(numbers_[begin + i] >= 0 && numbers_[begin + i] <= 255)) {
        words_.fail("a colour has " + rounded(numbers_[begin + i]) + "; expected numbers from 0 to 1, or to 255");
      }
      return double{static_cast<float>(numbers_[begin + i])};
    };
    see_through_ += count == 4 && (numbers_[begin + 3] < 1 || (numbers_[begin + 3] > 1 && numbers_[begin + 3] < 255)) ? 1 : 0;
    return Color{from_zero(0), from_zero(1), from_zero(2)};
  }

  void read_rest_of_line() {
    for (std::string_view word = words_.next_in_line(); !word.empty(); word = words_.next_in_line()) {
      constexpr std::size_t most = 16;
      if (numbers_.size() == most) {
        words_.fail_at(word, "no more than " + std::to_string(most) + " numbers of a vertex, or of a face's colour");
      }
      numbers_.push_back(number_or_none(word, "a number"));
    }
  }

  std::uint64_t room() const { return (bytes_ - words_.position()) / 2 + 1; }

  std::string_view text_;
  LineWords words_;
  ReadingProgress& progress_;
  std::size_t bytes_;
  bool has_colors_ = false, has_normals_ = false, has_places_ = false;
  std::uint64_t vertices_ = 0, faces_ = 0, thin_ = 0, from_map_ = 0, see_through_ = 0, strays_ = 0;
  std::size_t first_stray_ = 0;  ///< line of the first one
  PolygonMesh mesh_{.name = "the mesh", .is_by_vertex = true};
  FaceLooks looks_;
  std::vector<double> numbers_;  ///< of the current line
  std::vector<std::uint32_t> corners_;
};

}  // namespace

PlacedFile read_off(const std::string& path, SceneFiles& files) {
  return read_whole(path, files, [](std::string_view file, ReadingProgress& progress) {
    return OffReader(without_mark(file), progress).read();
  });
}

}  // namespace dmpc::apps

#include "apps/foreign/obj/counts.h"

#include <algorithm>
#include <cstdint>

#include "apps/foreign/text/word_count.h"
#include "core/base/vec.h"

namespace dmpc::apps::obj {
namespace {

struct Statements {
  std::uint64_t vertices = 0, numbers_of_vertices = 0, normals = 0, places = 0, faces = 0, corners = 0, groups = 0;
};

/// The first word, and all words; what follows a backslash at a line's end belongs to it.
void count(std::string_view line, Statements& all) {
  const std::string_view word = line.substr(0, line.find_first_of(" \t\\\r"));
  if (word == "v") {
    ++all.vertices;
    all.numbers_of_vertices += count_words(line) - 1;
  } else if (word == "vn") {
    ++all.normals;
  } else if (word == "vt") {
    ++all.places;
  } else if (word == "f" || word == "fo") {
    ++all.faces;
    all.corners += count_words(line) - 1;
  } else if (word == "s") {
    ++all.groups;
  }
}

/// The length of a line that begins the text, without its end.
std::size_t line_length(std::string_view text) {
  std::size_t end = std::min(text.find('\n'), text.size());
  while (end < text.size() && end > 0 && (text[end - 1] == '\\' || (end > 1 && text.substr(end - 2, 2) == "\\\r"))) {
    end = std::min(text.find('\n', end + 1), text.size());
  }
  return end;
}

Statements statements_of(std::string_view file) {
  Statements all;
  while (!file.empty()) {
    const std::size_t length = line_length(file);
    std::string_view line = file.substr(0, length);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    count(line, all);
    file.remove_prefix(std::min(length + 1, file.size()));
  }
  return all;
}

}  // namespace

MeshCounts counts_of(std::string_view file) {
  const Statements all = statements_of(file);
  MeshCounts counts{.vertices = all.vertices,
                    .faces = all.faces,
                    .corners = all.corners,
                    .has_normals = all.normals > 0 || all.groups > 0,
                    .has_places = all.places > 0,
                    .has_colors = all.numbers_of_vertices > 4 * all.vertices,
                    .triangles_min = all.faces};
  constexpr std::uint64_t index = sizeof(std::uint32_t), vec = sizeof(core::Vec3d);
  const std::uint64_t of_corner = index * (1 + (counts.has_normals ? 1 : 0) + (counts.has_places ? 1 : 0));
  const std::uint64_t geometry = vec * all.vertices * (counts.has_colors ? 2 : 1) + vec * all.normals +
                                 2 * sizeof(double) * all.places + of_corner * all.corners +
                                 (all.groups > 0 ? 2 : 1) * index * all.faces;
  const std::uint64_t smoothing = all.groups > 0 ? 2 * vec * all.vertices + vec * (all.corners + all.faces) : 0;
  const std::uint64_t copied = std::max(vec * std::max(all.vertices, all.normals), index * all.corners);  // lists grow by copies
  counts.read_bytes = geometry + smoothing + std::max<std::uint64_t>(file.size(), index * all.vertices) + copied;
  return counts;
}

}  // namespace dmpc::apps::obj

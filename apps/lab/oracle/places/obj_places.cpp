#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <utility>

#include "apps/lab/oracle/places/file_places.h"

namespace dmpc::apps {
namespace {

using ObjWords = std::vector<std::string>;

/// Returns the words of the next line; a backslash at its end, outside a comment, joins it with the next. Returns nothing after
/// the last line.
std::optional<ObjWords> next_words(std::istream& lines) {
  std::string line, more;
  bool is_there = false, goes_on = true;
  while (goes_on && std::getline(lines, more)) {
    is_there = true;
    goes_on = more.ends_with('\\') && more.find('#') == std::string::npos;
    line += more.substr(0, goes_on ? more.size() - 1 : more.find('#')) + " ";
  }
  std::istringstream words(line);
  return is_there ? std::optional(ObjWords(std::istream_iterator<std::string>(words), {})) : std::nullopt;
}

}  // namespace

void read_obj_places(std::string file, double scale, FilePlaces& places) {
  for (std::size_t at = file.find('\r'); at != std::string::npos; at = file.find('\r', at + 1)) {
    file[at] = file.compare(at, 2, "\r\n") == 0 ? ' ' : '\n';
  }
  std::istringstream lines(std::move(file));
  std::vector<core::Vec3d> vertices, face;
  std::vector<std::vector<std::size_t>> faces;  // their vertices may follow later
  while (const auto words = next_words(lines)) {
    places.spend(1);
    const std::size_t count = words->size();
    if (count > 3 && words->front() == "v") {  // "x y z", "x y z w" or "x y z r g b"
      const auto number = [&](std::size_t i) { return std::strtod((*words)[i].c_str(), nullptr); };
      vertices.push_back(core::Vec3d{number(1), number(2), number(3)} * (scale / (count == 5 ? number(4) : 1)));
    } else if (count > 3 && (words->front() == "f" || words->front() == "fo")) {  // corners such as 3, 3/1 or -1//-1
      faces.emplace_back();
      for (std::size_t i = 1; i < count; ++i) {
        const long long index = std::strtoll((*words)[i].c_str(), nullptr, 10);
        faces.back().push_back(static_cast<std::size_t>(index) + (index < 0 ? vertices.size() : std::size_t{0} - 1));
      }
    }
  }
  for (const std::vector<std::size_t>& corners : faces) {
    face.clear();
    for (const std::size_t corner : corners) {
      face.push_back(vertices.at(corner));
    }
    places.add(face);
  }
}

}  // namespace dmpc::apps

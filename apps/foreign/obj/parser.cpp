#include "apps/foreign/obj/parser.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/obj/corner.h"
#include "apps/foreign/obj/unknown_words.h"
#include "apps/foreign/text/line_words.h"
#include "apps/foreign/text/text_lines.h"
#include "apps/formats/nff_reader.h"
#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/small_letters.h"
#include "core/base/expect.h"
#include "core/base/srgb.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;

constexpr std::size_t libraries_max = 1000;
constexpr const char* thin = "points and lines left out";
constexpr const char* free_form = "statements about free-form curves and surfaces left out";
constexpr const char* strange_colors = "vertices whose colour lies outside 0 to 1, brought into it";

/// A statement that is counted, and its text for notes; statements without text do not affect our pictures.
struct LeftOut {
  std::string_view statement;
  const char* words;
};
constexpr std::array left_out{
    LeftOut{"p", thin},
    LeftOut{"l", thin},
    LeftOut{"surf", "free-form surfaces left out"},
    LeftOut{"bzp", "free-form surfaces left out"},
    LeftOut{"bsp", "free-form surfaces left out"},
    LeftOut{"cdp", "free-form surfaces left out"},
    LeftOut{"curv", "free-form curves left out"},
    LeftOut{"curv2", "free-form curves left out"},
    LeftOut{"cdc", "free-form curves left out"},
    LeftOut{"vp", free_form},
    LeftOut{"cstype", free_form},
    LeftOut{"deg", free_form},
    LeftOut{"bmat", free_form},
    LeftOut{"step", free_form},
    LeftOut{"parm", free_form},
    LeftOut{"trim", free_form},
    LeftOut{"hole", free_form},
    LeftOut{"scrv", free_form},
    LeftOut{"sp", free_form},
    LeftOut{"end", free_form},
    LeftOut{"con", free_form},
    LeftOut{"ctech", free_form},
    LeftOut{"stech", free_form},
    LeftOut{"res", free_form},
    LeftOut{"o", nullptr},
    LeftOut{"g", nullptr},
    LeftOut{"mg", "merging groups not followed"},
    LeftOut{"bevel", "statements bevel, which are not followed"},
    LeftOut{"c_interp", "statements c_interp, which are not followed"},
    LeftOut{"d_interp", "statements d_interp, which are not followed"},
    LeftOut{"lod", "levels of detail not followed"},
    LeftOut{"usemap", "statements usemap, whose textures are not shown"},
    LeftOut{"maplib", "statements maplib, whose textures are not shown"},
    LeftOut{"shadow_obj", "statements shadow_obj, whose files are not read"},
    LeftOut{"trace_obj", "statements trace_obj, whose files are not read"},
    LeftOut{"call", "statements call, which are not carried out"},
    LeftOut{"csh", "statements csh, which are not carried out"},
};

class Parser {
 public:
  explicit Parser(SceneTotals& totals) : totals_(totals) {}

  Geometry read(std::string_view file, const std::function<void(float)>& passed) {
    for (TextLines lines(file, LineJoin::backslash); lines.next();) {
      LineWords words(lines.line(), lines.number());
      statement(words);
      passed(static_cast<float>(static_cast<double>(lines.bytes_passed()) / static_cast<double>(file.size())));
    }
    corner_reader_.check_named(counts());
    judge_strays();
    tally_.add_to(result_.notes);
    note_count(result_.notes, "vertices without a colour beside others that have one, shown white",
               result_.colors.empty() ? 0 : result_.vertices.size() - colored_);
    unknown_.note("unknown statements left out", result_.notes);
    return std::move(result_);
  }

 private:
  void statement(LineWords& words) {
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      vertex(words);
    } else if (keyword == "vt") {
      place(words);
    } else if (keyword == "vn") {
      normal(words);
    } else if (keyword == "f" || keyword == "fo") {
      face(words);
    } else if (keyword == "s") {
      smoothing(words);
    } else if (keyword == "usemtl") {
      material(words);
    } else if (keyword == "mtllib") {
      library(words);
    } else if (!keyword.empty()) {
      other(keyword, words);
    }
  }

  /// Parses "x y z", "x y z w" or "x y z r g b".
  void vertex(LineWords& words) {
    Vec3d position = coordinates(words);
    if (words.has_next()) {
      const double fourth = number(words);
      if (words.has_next()) {
        const double green = number(words), blue = number(words);
        color({fourth, green, blue});
      } else if (fourth != 1 && !is_stray_) {
        position = position * (1 / fourth);
      }
      if (!is_in_reach(position)) {
        words.fail("divided by its weight a coordinate is beyond 1e30; correct the file");
      }
      words.expect_end();
    }
    result_.vertices.push_back(position);
    keep_stray(Named::vertex, result_.vertices.size(), words);
    if (!result_.colors.empty()) {
      result_.colors.resize(result_.vertices.size(), {1, 1, 1});
    }
    if (result_.vertices.size() >= none) {
      throw core::CapacityError("there are more than " + grouped(none - 1) + " vertices; divide the file");
    }
  }

  /// Parses "u", "u v" or "u v w"; w is not used.
  void place(LineWords& words) {
    std::array<double, 2> place{number(words), 0};
    if (words.has_next()) {
      place[1] = number(words);
    }
    if (words.has_next()) {
      number(words);
      words.expect_end();
    }
    if (!is_in_reach({place[0], place[1], 0})) {
      words.fail("a texture coordinate is beyond 1e30; correct the file");
    }
    result_.places.push_back(place);
    keep_stray(Named::place, result_.places.size(), words);
  }

  void normal(LineWords& words) {
    result_.normals.push_back(coordinates(words));
    keep_stray(Named::normal, result_.normals.size(), words);
    words.expect_end();
  }

  void face(LineWords& words) {
    face_.clear();
    const Counts so_far = counts();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      face_.push_back(corner_reader_.read(word, words, so_far));
      if (face_.size() > std::size_t{polygon_vertices_max}) {
        words.fail("the face has too many corners, more than " + grouped(polygon_vertices_max) + "; divide it");
      }
    }
    if (face_.size() < 3) {
      return tally_.count(face_.empty() ? "faces without a corner left out" : thin);
    }
    add_face(words);
  }

  /// A group is any 32-bit number, since some programs write sets of bits.
  void smoothing(LineWords& words) {
    LineWords ahead = words;
    const std::string word = in_small_letters(ahead.next());
    if (word.empty() || word == "off" || word == "on") {
      words = ahead;
      group_ = word == "on" ? 1 : 0;
    } else {
      const std::int64_t group = words.integer();
      if (group < std::numeric_limits<std::int32_t>::min() || group > std::numeric_limits<std::uint32_t>::max()) {
        words.fail_at(std::to_string(group), "a smoothing group, a number of 32 bits, or 'off'");
      }
      group_ = static_cast<std::uint32_t>(group);
    }
    words.expect_end();
  }

  void material(LineWords& words) {
    const auto [known, is_new] =
        names_.try_emplace(std::string(words.rest_of_line()), static_cast<std::uint32_t>(result_.material_names.size()));
    if (is_new) {
      result_.material_names.push_back(known->first);
    }
    material_ = known->second;
  }

  void library(LineWords& words) {
    const std::string_view names = words.rest_of_line();
    if (without_remark(names).empty()) {
      words.fail_at("", "the name of a file of materials");
    }
    if (!libraries_.insert(std::string(names)).second) {
      return;
    }
    if (libraries_.size() > libraries_max) {
      words.fail("more than " + grouped(libraries_max) + " files of materials are named; join them");
    }
    result_.libraries.emplace_back(names);
  }

  void other(std::string_view keyword, const LineWords& words) {
    const auto known =
        std::find_if(left_out.begin(), left_out.end(), [keyword](const LeftOut& one) { return one.statement == keyword; });
    if (known != left_out.end()) {
      if (known->words != nullptr) {
        tally_.count(known->words);
      }
    } else {
      unknown_.add(keyword, words.line());
    }
  }

  /// Returns 0 for a non-finite number, which makes the vertex, texture coordinate or normal a stray.
  double number(LineWords& words) {
    LineWords ahead = words;
    if (!is_no_number(ahead.next())) {
      return words.number();
    }
    words = ahead;
    is_stray_ = true;
    return 0;
  }

  /// Remembers the last vertex, texture coordinate or normal that contains NaN.
  void keep_stray(Named what, std::size_t count, const LineWords& words) {
    if (std::exchange(is_stray_, false)) {
      strays_[static_cast<std::size_t>(what)].push_back({count - 1, words.line()});
    }
  }

  /// Throws if a face uses a stray; notes the others.
  void judge_strays() {
    const std::array<const std::vector<std::uint32_t>*, named_count> lists{&result_.faces.corners, &result_.faces.places,
                                                                           &result_.faces.normals};
    const std::array<const char*, named_count> names{"vertices", "texture coordinates", "normals"};
    for (std::size_t kind = 0; kind < named_count; ++kind) {
      const std::vector<Stray>& strays = strays_[kind];
      if (strays.empty()) {
        continue;
      }
      std::vector<bool> is_seen(counts()[kind]);
      for (const std::uint32_t index : *lists[kind]) {
        if (index != none) {
          is_seen[index] = true;
        }
      }
      for (const auto& [index, line] : strays) {
        if (is_seen[index]) {
          throw core::InputError("line " + std::to_string(line) + ": expected a number, found what is none, and a face has it; " +
                                 "correct the file");
        }
      }
      tally_.count(std::string(names[kind]) + " of what is no number, left out as no face has them (the first in line " +
                       std::to_string(strays.front().line) + ")",
                   strays.size());
    }
  }

  Vec3d coordinates(LineWords& words) {
    Vec3d v;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      v[axis] = number(words);
    }
    if (!is_in_reach(v)) {
      words.fail("a coordinate is beyond 1e30; correct the file");
    }
    return v;
  }

  /// Sets the current vertex's colour.
  void color(const Vec3d& color) {
    const auto clamped = [](double channel) { return std::clamp(channel, 0.0, 1.0); };
    const Vec3d shown{clamped(color.x), clamped(color.y), clamped(color.z)};
    if (!(shown == color)) {
      tally_.count(strange_colors);
    }
    ++colored_;
    result_.colors.resize(result_.vertices.size(), {1, 1, 1});
    const auto linear = [](double channel) { return core::linear_from_srgb(channel); };
    result_.colors.push_back({linear(shown.x), linear(shown.y), linear(shown.z)});
  }

  void add_face(const LineWords& words) {
    totals_.add(size_of_faces(1, face_.size()), [&words] { return "line " + std::to_string(words.line()) + ": "; });
    start_run();
    Faces& faces = result_.faces;
    add_named(Named::place, faces.places, words);
    add_named(Named::normal, faces.normals, words);
    for (const Corner& corner : face_) {
      faces.corners.push_back(corner[0]);
    }
    if (group_ != 0) {
      faces.groups.resize(faces.ends.size());
    }
    if (group_ != 0 || !faces.groups.empty()) {
      faces.groups.push_back(group_);
    }
    faces.ends.push_back(static_cast<std::uint32_t>(faces.corners.size()));
  }

  /// Adds texture coordinates or normals of a face's corners, of which all have one or none.
  void add_named(Named what, std::vector<std::uint32_t>& list, const LineWords& words) {
    const auto kind = static_cast<std::size_t>(what);
    const auto has_one = [kind](const Corner& corner) { return corner[kind] != none; };
    const bool has_any = std::any_of(face_.begin(), face_.end(), has_one);
    if (has_any && !std::all_of(face_.begin(), face_.end(), has_one)) {
      words.fail(std::string("the face has a ") + (what == Named::place ? "texture coordinate" : "normal") +
                 " at some corners and none at others; expected it at all or at none");
    }
    if (!has_any && list.empty()) {
      return;
    }
    list.resize(result_.faces.corners.size(), none);
    for (const Corner& corner : face_) {
      list.push_back(corner[kind]);
    }
  }

  /// Starts a run if the material has changed.
  void start_run() {
    const auto face = static_cast<std::uint32_t>(result_.faces.ends.size());
    if (result_.runs.empty() || result_.runs.back().name != material_) {
      result_.runs.push_back({face, material_});
    }
  }

  Counts counts() const { return {result_.vertices.size(), result_.places.size(), result_.normals.size()}; }

  Geometry result_;
  CornerReader corner_reader_;
  std::vector<Corner> face_;  ///< the face that is being read
  SceneTotals& totals_;
  std::uint32_t group_ = 0;        ///< smoothing group of the faces that follow
  std::uint32_t material_ = none;  ///< material of the faces that follow
  std::unordered_map<std::string, std::uint32_t> names_;
  std::unordered_set<std::string> libraries_;
  Notes tally_;
  std::uint64_t colored_ = 0;  ///< number of coloured vertices
  UnknownWords unknown_;
  /// An element with a non-finite number, by Named.
  struct Stray {
    std::size_t index, line;
  };
  std::array<std::vector<Stray>, named_count> strays_;
  bool is_stray_ = false;  ///< whether the current element is one
};

}  // namespace

Geometry parse_obj(std::string_view file, const std::function<void(float)>& passed, SceneTotals& totals) {
  return Parser(totals).read(file, passed);
}

}  // namespace dmpc::apps::obj

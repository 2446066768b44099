#include "apps/foreign/mesh/collada_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "apps/foreign/mesh/collada_bindings.h"
#include "apps/foreign/text/xml_tags.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view no_highlight = "<specular><color>0 0 0 1</color></specular><shininess><float>0</float></shininess>";
constexpr std::string_view whole_reflection = "<reflectivity><float>1</float></reflectivity>";
constexpr std::string_view no_diffuse = "<diffuse><color>0 0 0 1</color></diffuse>";

constexpr std::string_view plain_profile =
    R"(<profile_COMMON><technique sid="t"><lambert><diffuse><color>0.6 0.6 0.6 1</color></diffuse>)"
    R"(<specular><color>0 0 0 1</color></specular><shininess><float>0</float></shininess></lambert></technique></profile_COMMON>)";

/// Before all others in the order of ids and symbols.
const std::string plain_material =
    R"(<library_effects><effect id=" ">)" + std::string(plain_profile) +
    R"(</effect></library_effects><library_materials><material id=" "><instance_effect url="# "/></material></library_materials>)";
constexpr std::string_view plain_instance = R"(<instance_material symbol="" target="# "/>)";

struct TexcoordInput {
  Tag tag;
  unsigned set = 0;
};

/// What an accessor calls its values.
struct AccessorNames {
  std::vector<std::string_view> values;
  std::vector<std::size_t> nameless;  ///< where a name is to stand
  bool are_known = true, are_numbers = true;
};

AccessorNames accessor_names(std::string_view text, const Tag& accessor) {
  constexpr std::string_view known = "XYZRGBASTPUV";
  constexpr std::size_t bytes_max = 4096;  // so that those that are not closed take no longer
  const std::string_view ahead = text.substr(accessor.end, bytes_max);
  AccessorNames names;
  for_each_tag(ahead.substr(0, ahead.find("</accessor")), [&](const Tag& param) {
    if (!param.is("param")) {
      return;
    }
    names.are_numbers = names.are_numbers && value_of(param, "type") == "float";
    if (const auto name = attribute(param, "name")) {
      names.values.push_back(*name);
      names.are_known = names.are_known && name->size() == 1 && known.find(*name) != std::string_view::npos;
    } else {
      names.nameless.push_back(accessor.end + param.end_of_name());
    }
  });
  return names;
}

class ColladaFiller {
 public:
  explicit ColladaFiller(std::string_view text) : text_(text), sets_(collada_sets(text)), filled_(text) {}

  std::string fill();

 private:
  void fill_effect(const Tag& tag);
  void fill_camera(const Tag& tag);
  void fill_accessor(const Tag& tag);
  void fill_materials(const Tag& tag);
  void fill_faces(const Tag& tag, std::string_view name);
  void number_sets(const Tag& tag, std::string_view name, const std::string& symbol);
  /// A sign before the value of the attribute.
  void mark(std::string_view value) { filled_.insert(filled_.place_of(value), "="); }

  std::string_view text_;
  ColladaSets sets_;
  Filled filled_;
  std::string geometry_;
  bool binds_ = false, is_common_ = false;
};

void ColladaFiller::fill_effect(const Tag& tag) {
  if (tag.is("effect") || tag.is("profile_COMMON")) {
    is_common_ = tag.is("profile_COMMON");
  } else if (tag.is("/effect") && !is_common_) {
    filled_.insert(tag.begin, plain_profile);
  }
  for (const std::string name : {"lambert", "constant", "phong", "blinn"}) {
    const bool has_highlight = name == "phong" || name == "blinn";
    const std::string first = name == "constant" ? std::string(no_diffuse) : "";
    if (tag.is(name) && tag.is_whole()) {
      filled_.leave_out(tag.end - 2, tag.end);
      filled_.insert(tag.end, ">" + first + std::string(no_highlight) + "</" + name + ">");
    } else if (tag.is(name)) {
      filled_.insert(tag.end, std::string(whole_reflection) + first);  // what the file says follows, and counts
      filled_.insert(tag.end, has_highlight ? no_highlight : "");
    } else if (tag.is("/" + name) && !has_highlight) {
      filled_.insert(tag.begin, no_highlight);
    }
  }
}

void ColladaFiller::fill_camera(const Tag& tag) {
  if (tag.is("camera") && !tag.is_whole() && value_of(tag, "name").empty()) {
    filled_.insert(tag.end - 1, " name=\"" + value_of(tag, "id") + "\"");
  }
  if (!tag.is("perspective") || tag.is_whole()) {
    return;
  }
  const std::string_view inside = text_.substr(tag.end, text_.find("</perspective", tag.end) - tag.end);
  const auto has = [&](std::string_view what) { return inside.find(what) != std::string_view::npos; };
  if (has("<yfov") && !has("<xfov") && !has("<aspect_ratio")) {
    filled_.insert(tag.end, "<aspect_ratio>1</aspect_ratio>");
  }
}

/// Values come in the order in which they stand, whatever they are called, and as Assimp's names for them.
void ColladaFiller::fill_accessor(const Tag& tag) {
  constexpr std::array<std::string_view, 4> places{"X", "Y", "Z", "A"};
  if (!tag.is("accessor") || tag.is_whole()) {
    return;
  }
  const AccessorNames names = accessor_names(text_, tag);
  const bool has_names = !names.values.empty();  // what has none beside them is passed over
  const std::size_t count = has_names ? names.values.size() : names.nameless.size();
  if ((has_names && names.are_known) || !names.are_numbers || count < 2 || count > places.size()) {
    return;
  }
  for (std::size_t i = 0; i < names.values.size(); ++i) {
    const std::size_t begin = filled_.place_of(names.values[i]);
    filled_.leave_out(begin, begin + names.values[i].size());
    filled_.insert(begin + names.values[i].size(), places[i]);
  }
  for (std::size_t i = 0; i < names.nameless.size() && !has_names; ++i) {
    filled_.insert(names.nameless[i], " name=\"" + std::string(places[i]) + "\"");
  }
}

void ColladaFiller::fill_materials(const Tag& tag) {
  if (tag.is("COLLADA") && !tag.is_whole()) {
    filled_.insert(tag.end, plain_material);
  } else if (tag.is("bind_material") || tag.is("/bind_material")) {
    binds_ = tag.is("bind_material") && !tag.is_whole();
  } else if (tag.is("technique_common") && binds_ && !tag.is_whole()) {
    filled_.insert(tag.end, plain_instance);
  } else if (tag.is("instance_material")) {
    if (const auto symbol = attribute(tag, "symbol")) {
      mark(*symbol);
    }
  } else if (tag.is("geometry")) {
    geometry_ = value_of(tag, "id");
  }
}

/// The one that shows the texture gets number 0, or the first if none is named; the others come behind it.
void ColladaFiller::number_sets(const Tag& tag, std::string_view name, const std::string& symbol) {
  const std::size_t end = std::min(text_.find("</" + std::string(name), tag.end), text_.size());
  std::vector<TexcoordInput> inputs;
  unsigned least = std::numeric_limits<unsigned>::max();
  for_each_tag(text_.substr(tag.end, end - tag.end), [&](const Tag& input) {
    if (input.is("input") && value_of(input, "semantic") == "TEXCOORD") {
      inputs.push_back(
          {{input.inside, tag.end + input.begin, tag.end + input.end}, leading_number(value_of(input, "set")).value_or(0)});
      least = std::min(least, inputs.back().set);
    }
  });
  const auto bound = sets_.find({geometry_, symbol});
  const auto is_bound = [&](const TexcoordInput& input) { return bound != sets_.end() && input.set == bound->second; };
  const unsigned chosen = std::any_of(inputs.begin(), inputs.end(), is_bound) ? bound->second : least;
  for (const TexcoordInput& input : inputs) {
    if (const auto set = attribute(input.tag, "set")) {
      filled_.leave_out(filled_.place_of(*set), filled_.place_of(*set) + set->size());
      filled_.insert(filled_.place_of(*set) + set->size(), input.set == chosen ? "0" : std::to_string(input.set + 1));
    } else {
      filled_.insert(input.tag.end_of_name(), input.set == chosen ? "" : R"( set="1")");
    }
  }
}

void ColladaFiller::fill_faces(const Tag& tag, std::string_view name) {
  const auto symbol = attribute(tag, "material");
  if (symbol) {
    mark(*symbol);
  } else {
    filled_.insert(tag.end_of_name(), R"( material="=")");
  }
  number_sets(tag, name, std::string(symbol.value_or("")));
}

std::string ColladaFiller::fill() {
  for_each_tag(text_, [&](const Tag& tag) {
    fill_effect(tag);
    fill_camera(tag);
    fill_accessor(tag);
    fill_materials(tag);
    for (const char* const faces : {"triangles", "polylist", "polygons", "tristrips", "trifans"}) {
      if (tag.is(faces) && !tag.is_whole()) {
        fill_faces(tag, faces);
      }
    }
  });
  return filled_.finish();
}

}  // namespace

std::string collada_in_full(std::string_view text) { return ColladaFiller(text).fill(); }

}  // namespace dmpc::apps

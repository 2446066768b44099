#include "apps/foreign/mesh/collada_bindings.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <system_error>
#include <vector>

#include "apps/edge/line/shown_text.h"
#include "apps/foreign/text/name_list.h"
#include "apps/foreign/text/xml_tags.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// "#name" without its begin.
std::string target(const Tag& tag, std::string_view name) {
  const std::string value = value_of(tag, name);
  return value.substr(value.starts_with('#') ? 1 : 0);
}

struct BoundSymbol {
  std::string instance, symbol, material;
  std::vector<std::pair<std::string, unsigned>> inputs;  ///< the texture's name of its coordinates, and the set
};

class Bindings {
 public:
  void take(const Tag& tag);
  ColladaSets sets() const;
  void note_loose(std::vector<std::string>& notes) const;

 private:
  void take_library(const Tag& tag);
  void take_instance(const Tag& tag);
  std::string geometry_of(const std::string& instance) const;
  std::optional<unsigned> set_of(const BoundSymbol& bound) const;

  std::string material_, effect_, controller_, instance_;  ///< in which the text is
  bool is_in_diffuse_ = false;
  std::set<std::string> material_ids_, effect_ids_;
  std::map<std::string, std::string> effects_;   ///< of materials
  std::map<std::string, std::string> channels_;  ///< of effects: their textures' names of coordinates
  std::map<std::string, std::string> skinned_;   ///< of controllers: geometries, or controllers
  std::vector<BoundSymbol> bound_;
};

void Bindings::take(const Tag& tag) {
  take_library(tag);
  take_instance(tag);
}

void Bindings::take_library(const Tag& tag) {
  if (tag.is("material")) {
    material_ = value_of(tag, "id");
    material_ids_.insert(material_);
  } else if (tag.is("instance_effect")) {
    effects_[material_] = target(tag, "url");
  } else if (tag.is("effect")) {
    effect_ = value_of(tag, "id");
    effect_ids_.insert(effect_);
  } else if (tag.is("diffuse") || tag.is("/diffuse")) {
    is_in_diffuse_ = tag.is("diffuse");
  } else if (tag.is("texture") && is_in_diffuse_) {
    channels_[effect_] = value_of(tag, "texcoord");
  } else if (tag.is("controller")) {
    controller_ = value_of(tag, "id");
  } else if (tag.is("skin") || tag.is("morph")) {
    skinned_[controller_] = target(tag, "source");
  }
}

void Bindings::take_instance(const Tag& tag) {
  if (tag.is("instance_geometry") || tag.is("instance_controller")) {
    instance_ = target(tag, "url");
  } else if (tag.is("instance_material")) {
    bound_.push_back({instance_, value_of(tag, "symbol"), target(tag, "target"), {}});
  } else if (tag.is("bind_vertex_input") && !bound_.empty()) {
    const unsigned set = leading_number(value_of(tag, "input_set")).value_or(0);
    bound_.back().inputs.emplace_back(value_of(tag, "semantic"), set);
  }
}

/// A skin may be laid over a morph.
std::string Bindings::geometry_of(const std::string& instance) const {
  std::string name = instance;
  for (int step = 0; step < 2; ++step) {
    const auto found = skinned_.find(name);
    name = found == skinned_.end() ? name : found->second;
  }
  return name;
}

std::optional<unsigned> Bindings::set_of(const BoundSymbol& bound) const {
  const auto effect = effects_.find(bound.material);
  const auto channel = effect == effects_.end() ? channels_.end() : channels_.find(effect->second);
  if (channel == channels_.end()) {
    return std::nullopt;
  }
  const std::string& name = channel->second;
  const auto input = std::find_if(bound.inputs.begin(), bound.inputs.end(), [&](const auto& one) { return one.first == name; });
  const std::size_t digit = std::min(name.find_first_of("0123456789"), name.size());
  return input == bound.inputs.end() ? leading_number(std::string_view(name).substr(digit)) : input->second;
}

ColladaSets Bindings::sets() const {
  ColladaSets sets;
  for (const BoundSymbol& bound : bound_) {
    const auto set = set_of(bound);
    const std::string geometry = geometry_of(bound.instance);
    if (set && sets.try_emplace({geometry, bound.symbol}, *set).first->second != *set) {
      throw core::InputError(
          "the geometry '" + clipped(geometry, 60) + "' shows a texture by set " + std::to_string(*set) +
          " of its texture coordinates in one place and by another in another, which is not shown; write the " +
          "file as glTF, or the geometry twice");
    }
  }
  return sets;
}

void Bindings::note_loose(std::vector<std::string>& notes) const {
  std::set<std::string> materials, effects;
  for (const BoundSymbol& bound : bound_) {
    const auto effect = effects_.find(bound.material);
    if (!material_ids_.contains(bound.material)) {
      materials.insert(bound.material);
    } else if (effect == effects_.end() || !effect_ids_.contains(effect->second)) {
      effects.insert(bound.material);
    }
  }
  note_names(notes, "materials that are bound and not in the file, shown grey", {materials.begin(), materials.end()});
  note_names(notes, "materials whose effect is not in the file, shown grey", {effects.begin(), effects.end()});
}

}  // namespace

std::optional<unsigned> leading_number(std::string_view text) {
  unsigned number = 0;
  const bool has_one = std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc{};
  return has_one ? std::optional(number) : std::nullopt;
}

ColladaSets collada_sets(std::string_view text) {
  Bindings bindings;
  for_each_tag(text, [&](const Tag& tag) { bindings.take(tag); });
  return bindings.sets();
}

void note_loose_bindings(std::string_view text, std::vector<std::string>& notes) {
  Bindings bindings;
  for_each_tag(text, [&](const Tag& tag) { bindings.take(tag); });
  bindings.note_loose(notes);
}

}  // namespace dmpc::apps

#include "core/database/shading/emitters.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "core/database/shading/choice_tree.h"

namespace dmpc::core {
namespace {

/// The minimum relative to the mean power: the rounding of probabilities would determine how often a weaker emitter is drawn.
constexpr double share_min = 0x1p-20;

struct Candidate {
  double power;
  std::uint32_t primitive;
};

/// 0 for primitives that are never sampled.
double area_of(const PrimitiveValues& primitive) {
  if (primitive.kind == PrimitiveKind::sphere) {
    const double radius = primitive.curved().value(3);
    return radius > 0.0 ? 4.0 * std::numbers::pi * radius * radius : 0.0;
  }
  if (primitive.kind == PrimitiveKind::cone) {
    return 0.0;
  }
  const Vec3d corner = primitive.vector(0);
  return 0.5 * length(cross(primitive.vector(3) - corner, primitive.vector(6) - corner));
}

class Chooser {
 public:
  Chooser(Conversion& conversion, const Scene& scene) : conversion_(conversion), scene_(scene) {}

  Emitters choose(std::uint32_t count_max) {
    find_candidates();
    keep(count_max);
    if (!drawn_.empty()) {
      write();
      name_materials();
    }
    result_.others -= drawn_.size();
    return std::move(result_);
  }

 private:
  const Material& material_of(std::uint32_t primitive) const {
    return scene_.materials[conversion_.shading[primitive].material()];
  }

  /// Emitters that other faces in their plane may cover completely.
  std::vector<bool> find_covered() const {
    std::vector<bool> is_covered(conversion_.primitives.size());
    for (std::uint32_t primitive = 0; primitive < is_covered.size(); ++primitive) {
      is_covered[primitive] = conversion_.primitives[primitive].plane() != 0;
    }
    for (const Conversion::Lamp& lamp : conversion_.whole_lamps) {
      is_covered[lamp.primitive] = false;
    }
    return is_covered;
  }

  void find_candidates() {
    const std::vector<bool> is_covered = find_covered();
    for (std::uint32_t primitive = 0; primitive < conversion_.primitives.size(); ++primitive) {
      const Material& material = material_of(primitive);
      const double strength = strength_of(Color(material.emission));
      result_.others += material.shines() && !is_covered[primitive] ? 1 : 0;
      result_.covered += material.shines() && is_covered[primitive] ? 1 : 0;
      const bool is_whole = material.alpha == AlphaUse::none && !is_covered[primitive];
      const double power = is_whole && strength > 0.0 ? strength * area_of(conversion_.primitives[primitive]) : 0.0;
      if (power > 0.0 && power < std::numeric_limits<double>::infinity()) {
        drawn_.push_back({power, primitive});
      }
    }
  }

  /// Keeps the emitters with the most power, in the order of their ids.
  void keep(std::uint32_t count_max) {
    if (drawn_.size() > count_max) {
      std::nth_element(drawn_.begin(), drawn_.begin() + count_max, drawn_.end(), [](const Candidate& a, const Candidate& b) {
        return a.power != b.power ? a.power > b.power : a.primitive < b.primitive;
      });
      drawn_.resize(count_max);
      std::sort(drawn_.begin(), drawn_.end(), [](const Candidate& a, const Candidate& b) { return a.primitive < b.primitive; });
    }
    const double least = sum() / static_cast<double>(std::max<std::size_t>(drawn_.size(), 1)) * share_min;
    std::erase_if(drawn_, [least](const Candidate& candidate) { return candidate.power < least; });
  }

  double sum() const {
    double sum = 0;
    for (const Candidate& candidate : drawn_) {
      sum += candidate.power;
    }
    return sum;
  }

  void write() {
    std::vector<double> powers;
    powers.reserve(drawn_.size());
    for (const Candidate& candidate : drawn_) {
      powers.push_back(candidate.power);
    }
    result_.choices = choice_tree(powers);
    const double all = sum();
    for (const Candidate& candidate : drawn_) {
      result_.records.push_back(record_of(candidate.primitive, candidate.power / all));
    }
    using Limits = std::numeric_limits<float>;
    result_.density = static_cast<float>(std::clamp(1.0 / all, double{Limits::min()}, double{Limits::max()}));
  }

  EmitterRecord record_of(std::uint32_t primitive, double chance) const {
    const PrimitiveValues& values = conversion_.primitives[primitive];
    EmitterRecord record{.corner = {},
                         .radiance = Color(material_of(primitive).emission),
                         .chance = static_cast<float>(chance),
                         .kind = values.kind,
                         .primitive = primitive};
    if (values.kind == PrimitiveKind::sphere) {
      record.corner = {Vec3f(values.curved().vector(0)), Vec3f{static_cast<float>(values.curved().value(3)), 0, 0}, Vec3f{}};
    } else {
      record.corner = {Vec3f(values.vector(0)), Vec3f(values.vector(3)), Vec3f(values.vector(6))};
    }
    return record;
  }

  /// Repeats each of the emitters' materials once, in order of first use.
  void name_materials() {
    const auto first = static_cast<std::uint32_t>(scene_.materials.size());
    std::unordered_map<std::uint32_t, std::uint32_t> names;
    for (const Candidate& candidate : drawn_) {
      ShadingReference& shading = conversion_.shading[candidate.primitive];
      const auto [name, is_new] = names.try_emplace(shading.material(), first + static_cast<std::uint32_t>(names.size()));
      if (is_new) {
        result_.materials.push_back(scene_.materials[shading.material()]);
      }
      shading = ShadingReference::flat(name->second);
    }
    for (Conversion::Smooth& smooth : conversion_.smooth) {
      rename(smooth.primitive, smooth.normals);
    }
    for (Conversion::Textured& textured : conversion_.textured) {
      rename(textured.primitive, textured.normals.normals);
    }
  }

  void rename(std::uint32_t primitive, PatchNormals& normals) const {
    normals.material_bits = (normals.material_bits & PatchNormals::textured_flag) | conversion_.shading[primitive].material();
  }

  Conversion& conversion_;
  const Scene& scene_;
  std::vector<Candidate> drawn_;
  Emitters result_;
};

}  // namespace

Emitters choose_emitters(Conversion& conversion, const Scene& scene, std::uint32_t count_max) {
  return Chooser(conversion, scene).choose(count_max);
}

}  // namespace dmpc::core

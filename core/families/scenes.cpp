#include "core/families/scenes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/base/ranges.h"
#include "core/families/families.h"
#include "core/families/tessellation.h"

namespace dmpc::core {
namespace {

/// Bounds the memory of a scene to 3 GiB of patches.
constexpr double primitives_max = 16'777'216;
constexpr int tessellation_max = 1000;
/// A size above that of any scene within the bound.
constexpr int any_size = 100'000;

/// The objects of a scene by kind. Doubles are exact below 2^53, and nothing overflows before the comparison with the bound.
struct Counts {
  double flat = 0, spheres = 0, cones = 0;
};

double power(double base, int exponent) {
  double result = 1;
  for (int i = 0; i < exponent && result < 1e30; ++i) {
    result *= base;
  }
  return result;
}

Counts count_balls(int n) { return {1, (power(9, n + 1) - 1) / 8, 0}; }
Counts count_gears(int n) { return {power(n, 3) * 146 + 1, 0, 0}; }
Counts count_jacks(int n) { return {0, 6 * (power(8, n) - 1) / 7, 3 * (power(8, n) - 1) / 7}; }
Counts count_lattice(int n) { return {0, power(n + 1.0, 3), 3.0 * n * power(n + 1.0, 2)}; }
Counts count_mount(int n) { return {2 * power(4, n), 4, 0}; }
Counts count_rings(int n) {
  const double each = 5.0 * n * (n + 1.0) * (2.0 * n + 1);
  return {1, each, each};
}
Counts count_shells(int n) { return {0, 180 * power(2, n) + 1, 0}; }
Counts count_sombrero(int n) { return {2 * power(32 * power(2, n - 1) - 1, 2), 0, 0}; }
Counts count_teapot(int n) { return {64.0 * n * n - 8.0 * n + 1.0 * n * n, 0, 0}; }
Counts count_tetra(int n) { return {power(4, n), 0, 0}; }
Counts count_tree(int n) { return {1, power(2, n + 1) - 1, power(2, n + 1) - 1}; }

double rounded(double value) { return round_to_6_digits(value); }

Vec3d rounded(const Vec3d& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

std::vector<Vec3d> rounded(const std::vector<Vec3d>& vectors) {
  return mapped<Vec3d>(vectors, [&](const Vec3d& vector) { return rounded(vector); });
}

/// Rounds every number to the 6 significant digits of an NFF file, so that a built-in scene is the same, bit for bit, as the file
/// written from it. Its target must outlive it.
class RoundingSink final : public SceneSink {
 public:
  explicit RoundingSink(SceneSink& target) : target_(target) {}

  void background(const Vec3d& color) override { target_.background(rounded(color)); }
  void view(const View& view) override {
    target_.view({rounded(view.from), rounded(view.at), rounded(view.up), rounded(view.angle_degrees), rounded(view.hither),
                  view.width, view.height});
  }
  void light(const PointLight& light) override {
    target_.light({rounded(light.position), rounded(light.color), light.has_color});
  }
  void material(const Material& material) override {
    target_.material({rounded(material.color), rounded(material.diffuse), rounded(material.specular), rounded(material.shine),
                      rounded(material.transmittance), rounded(material.refraction_index)});
  }
  void polygon(const std::vector<Vec3d>& vertices) override { target_.polygon(rounded(vertices)); }
  void patch(const std::vector<Vec3d>& vertices, const std::vector<Vec3d>& normals) override {
    target_.patch(rounded(vertices), rounded(normals));
  }
  void sphere(const Vec3d& center, double radius) override { target_.sphere(rounded(center), rounded(radius)); }
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) override {
    target_.cone(rounded(base), rounded(base_radius), rounded(apex), rounded(apex_radius));
  }

 private:
  SceneSink& target_;
};

struct Family {
  std::string_view name;
  int size_default = 1;
  Counts (*count)(int size) = nullptr;
  void (*make)(int size, SceneSink& sink) = nullptr;  ///< jacks: the curved form
};

constexpr std::array<Family, 11> families = {{
    {"balls", 4, count_balls, scenes::make_balls},
    {"gears", 4, count_gears, scenes::make_gears},
    {"jacks", 1, count_jacks, [](int size, SceneSink& sink) { scenes::make_jacks(size, false, sink); }},
    {"lattice", 12, count_lattice, scenes::make_lattice},
    {"mount", 6, count_mount, scenes::make_mount},
    {"rings", 7, count_rings, scenes::make_rings},
    {"shells", 5, count_shells, scenes::make_shells},
    {"sombrero", 1, count_sombrero, scenes::make_sombrero},
    {"teapot", 12, count_teapot, scenes::make_teapot},
    {"tetra", 6, count_tetra, scenes::make_tetra},
    {"tree", 11, count_tree, scenes::make_tree},
}};

const Family* find_family(std::string_view name) { return find_in(families, name, &Family::name); }

/// The tessellation that a family's scenes actually get.
int used_tessellation(const Family& family, int tessellation) {
  return family.name == "jacks" && tessellation > 0 ? 2 : tessellation;
}

double total(const Family& family, int size, int tessellation) {
  const Counts counts = family.count(size);
  const double n = used_tessellation(family, tessellation);
  return counts.flat + (n > 0 ? counts.spheres * 12 * n * n + counts.cones * 8 * n : counts.spheres + counts.cones);
}

/// The largest number from 1 to `limit` that `fits` accepts, or 0; `fits` must be monotonic.
int last_fitting(int limit, const std::function<bool(int)>& fits) {
  int low = 0, high = limit + 1;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

int size_max(const Family& family) {
  return last_fitting(any_size, [&](int size) { return total(family, size, 0) <= primitives_max; });
}

std::vector<std::string> family_names(std::span<const std::string> others) {
  std::vector<std::string> names = mapped<std::string>(families, &Family::name);
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

/// " Did you mean teapot-12?" for teapt-12: the nearest family, with the rest unchanged.
std::string family_meant(std::string_view text, const std::vector<std::string>& names) {
  const std::size_t end = std::min(text.find_first_of("-0123456789"), text.size());
  const std::optional<std::string> name = nearest_word(text.substr(0, end), names);
  const std::string hyphen = end < text.size() && text[end] != '-' ? "-" : "";
  return name ? " Did you mean " + *name + hyphen + std::string(text.substr(end)) + "?" : "";
}

[[noreturn]] void fail_on_family(std::string_view text, std::span<const std::string> others = {}) {
  const std::vector<std::string> names = family_names(others);
  std::string list;
  for (const std::string& name : names) {
    list += " " + name;
  }
  const std::string meant = family_meant(text, names);
  throw InputError("there is no built-in scene '" + std::string(text) +
                   "'; expected FAMILY-SIZE[-tTESSELLATION], for example rings-4-t1; the families are" + list +
                   (meant.empty() ? "" : ".") + meant);
}

const Family& family_of(const SceneName& name) {
  const Family* family = find_family(name.family);
  if (family == nullptr) {
    fail_on_family(name.family);
  }
  return *family;
}

std::string range_text(const Family& family) { return "1 to " + std::to_string(size_max(family)); }

/// Removes leading digits from `text` and returns their value; -1 if there are none, any_size + 1 if there are too many.
int take_number(std::string_view& text) {
  int value = -1;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::result_out_of_range) {
    value = any_size + 1;
  }
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return value;
}

bool starts_with_digit(std::string_view text) { return !text.empty() && text.front() >= '0' && text.front() <= '9'; }

/// Removes `-`, a tag and a number from the front of `text`; nothing if it does not begin with these.
std::optional<int> take_part(std::string_view& text, std::string_view tag) {
  if (!text.starts_with(tag) || !starts_with_digit(text.substr(tag.size()))) {
    return std::nullopt;
  }
  text.remove_prefix(tag.size());
  return take_number(text);
}

[[noreturn]] void fail_on_form(std::string_view text, const Family& family) {
  const std::string name(family.name);
  throw InputError("'" + std::string(text) + "' is not a built-in scene: expected " + name + ", " + name + "-SIZE, or " + name +
                   "-SIZE-tTESSELLATION, for example " + name + "-" + std::to_string(family.size_default) +
                   " (for a file of this name write ./" + std::string(text) + ")");
}

void check_tessellation(const Family& family, const SceneName& name) {
  const int largest = last_fitting(tessellation_max, [&](int n) { return total(family, name.size, n) <= primitives_max; });
  if (name.tessellation < 0 || (name.tessellation > 0 && largest == 0)) {
    throw InputError("built-in scene " + name.text() + ": too large to be tessellated; use a smaller size, or leave -t away");
  }
  if (name.tessellation > largest) {
    throw InputError("built-in scene " + name.text() + ": the tessellation of this size lies between 1 and " +
                     std::to_string(largest));
  }
}

}  // namespace

std::string SceneName::text() const {
  return family + "-" + std::to_string(size) + (tessellation > 0 ? "-t" + std::to_string(tessellation) : "");
}

void check_scene_name(const SceneName& name) {
  const Family& family = family_of(name);
  if (name.size < 1 || name.size > size_max(family)) {
    throw InputError("built-in scene " + name.text() + ": the size of " + name.family + " lies between 1 and " +
                     std::to_string(size_max(family)) + "; its default is " + std::to_string(family.size_default));
  }
  check_tessellation(family, name);
}

std::optional<SceneName> find_scene_name(std::string_view text) {
  const std::size_t hyphen = text.find('-');
  const Family* family = find_family(text.substr(0, hyphen));
  if (family == nullptr) {
    return std::nullopt;
  }
  std::string_view rest = hyphen == std::string_view::npos ? std::string_view() : text.substr(hyphen);
  SceneName name{.family = std::string(family->name), .size = family->size_default};
  name.size = take_part(rest, "-").value_or(family->size_default);
  const std::optional<int> tessellation = take_part(rest, "-t");
  if (rest.find_first_of("./") != std::string_view::npos) {
    return std::nullopt;  // balls-4.nff is a file
  }
  if (!rest.empty() || tessellation == 0) {
    fail_on_form(text, *family);
  }
  name.tessellation = tessellation.value_or(0);
  check_scene_name(name);
  return name;
}

SceneName parse_scene_name(std::string_view text, std::span<const std::string> others) {
  if (const std::optional<SceneName> name = find_scene_name(text)) {
    return *name;
  }
  fail_on_family(text, others);
}

std::vector<SceneName> default_scenes() {
  return mapped<SceneName>(
      families, [&](const Family& family) { return SceneName{.family = std::string(family.name), .size = family.size_default}; });
}

std::string describe_scene_families() {
  std::string text;
  for (const Family& family : families) {
    text += std::string(family.name) + std::string(10 - family.name.size(), ' ') + "size " + range_text(family) + ", default " +
            std::to_string(family.size_default) + "\n";
  }
  return text;
}

std::uint64_t primitive_count(const SceneName& name) {
  return static_cast<std::uint64_t>(total(family_of(name), name.size, name.tessellation));
}

void generate_unrounded_scene(const SceneName& name, SceneSink& sink) {
  check_scene_name(name);
  const Family& family = family_of(name);
  if (name.tessellation == 0) {
    return family.make(name.size, sink);
  }
  if (family.name == "jacks") {
    return scenes::make_jacks(name.size, true, sink);
  }
  scenes::TessellatingSink tessellated(name.tessellation, sink);
  family.make(name.size, tessellated);
}

void generate_scene(const SceneName& name, SceneSink& sink) {
  RoundingSink rounding(sink);
  generate_unrounded_scene(name, rounding);
}

Scene built_in_scene(const SceneName& name) {
  Scene scene;
  scene.name = name.text();
  SceneBuilder builder(scene);
  generate_scene(name, builder);
  return scene;
}

}  // namespace dmpc::core

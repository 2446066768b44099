#include "apps/formats/nff_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "apps/formats/nff_tokens.h"
#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr std::uint64_t entities_a_step = 1024;

constexpr double unbounded = std::numeric_limits<double>::infinity();

constexpr std::array<std::string_view, 6> view_parts = {"from", "at", "up", "angle", "hither", "resolution"};

class NffReader {
 public:
  NffReader(std::istream& input, const std::string& name, std::int64_t pixels_max, core::Scene& scene)
      : tokens_(input, name), builder_(scene), pixels_max_(pixels_max) {
    scene.name = name;
    scene.view = {};
    scene.background = {};
  }

  /// Calls `progress` now and then with the bytes read, if it is given.
  void read(const std::function<void(std::uint64_t)>& progress) {
    if (tokens_.peek().empty()) {
      tokens_.fail_at_next("the file is empty; expected an NFF scene with at least a view ('v')");
    }
    for (std::uint64_t count = 1; !tokens_.peek().empty(); ++count) {
      read_entity();
      if (progress && count % entities_a_step == 0) {
        progress(tokens_.bytes_read());
      }
    }
    if (view_line_ == 0) {
      tokens_.fail_at_next("the file ends without a view; add 'v' with from, at, up, angle, hither and resolution");
    }
  }

 private:
  void read_entity() {
    struct Entity {
      std::string_view keyword;
      void (NffReader::*read)();
    };
    static constexpr std::array<Entity, 8> entities = {{{"pp", &NffReader::read_patch},
                                                        {"p", &NffReader::read_polygon},
                                                        {"s", &NffReader::read_sphere},
                                                        {"c", &NffReader::read_cone},
                                                        {"f", &NffReader::read_material},
                                                        {"l", &NffReader::read_light},
                                                        {"v", &NffReader::read_view},
                                                        {"b", &NffReader::read_background}}};
    const std::string_view keyword = tokens_.take();
    for (const Entity& entity : entities) {
      if (entity.keyword == keyword) {
        return (this->*entity.read)();
      }
    }
    tokens_.fail("found " + quoted(keyword) +
                 ", expected one of the keywords v b l f c s p pp; correct it, or turn the line into a comment (#)");
  }

  void read_background() {
    forbid_second(background_line_, "b");
    const Vec3d color = vector("b (background)", "a colour component");
    check_color(color, 1, "a colour component of b (background)");
    builder_.background(color);
  }

  void read_view() {
    forbid_second(view_line_, "v");
    core::View view;
    std::array<bool, view_parts.size()> seen{};
    for (std::size_t i = 0; i < view_parts.size(); ++i) {
      const auto part = std::find(view_parts.begin(), view_parts.end(), tokens_.peek());
      const auto index = static_cast<std::size_t>(part - view_parts.begin());
      if (part == view_parts.end() || seen[index]) {
        const auto missing = static_cast<std::size_t>(std::find(seen.begin(), seen.end(), false) - seen.begin());
        tokens_.fail_at_next(tokens_.found() + ", expected '" + std::string(view_parts[missing]) +
                             "' of v (view); give from, at, up, angle, hither and resolution once each");
      }
      tokens_.take();
      seen[index] = true;
      read_view_part(view, index);
    }
    check_view(view);
    builder_.view(view);
  }

  void read_view_part(core::View& view, std::size_t part) {
    static constexpr const char* entity = "v (view)";
    switch (part) {
      case 0:
        view.from = vector(entity, "a coordinate of from");
        break;
      case 1:
        view.at = vector(entity, "a coordinate of at");
        break;
      case 2:
        view.up = vector(entity, "a component of up");
        break;
      case 3:
        view.angle_degrees = tokens_.number(entity, "the angle");
        break;
      case 4:
        view.hither = tokens_.number(entity, "the hither distance");
        break;
      default:
        view.width = tokens_.integer(entity, "the horizontal resolution", 1, resolution_max);
        view.height = tokens_.integer(entity, "the vertical resolution", 1, resolution_max);
        check_resolution(view);
    }
  }

  void check_resolution(const core::View& view) {
    if (std::int64_t{view.width} * view.height > pixels_max_) {
      tokens_.fail("found the resolution " + std::to_string(view.width) + " " + std::to_string(view.height) +
                   " of v (view), expected at most " + std::to_string(pixels_max_) +
                   " pixels in all; make it smaller, or give --resolution");
    }
  }

  void check_view(const core::View& view) {
    const std::optional<ViewFault> fault = fault_of(view);
    if (fault == ViewFault::angle) {
      tokens_.fail("found " + shortest(view.angle_degrees) +
                   " as the angle of v (view), expected degrees between 0 and 180, both excluded; correct it");
    }
    check_point(view.from, "from of v (view)");
    check_point(view.at, "at of v (view)");
    if (fault == ViewFault::direction) {
      tokens_.fail("found from and at of v (view) at the same point, expected two points; move one");
    }
    if (fault == ViewFault::up) {
      tokens_.fail(
          "found up of v (view) zero or parallel to the line from 'from' to 'at', expected another direction; change up");
    }
  }

  void check_point(const Vec3d& point, const std::string& name) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(point[i]) > view_coordinate_max) {
        tokens_.fail("found " + shortest(point[i]) + " as a coordinate of " + name +
                     ", expected a number from -1e30 to 1e30: this one is too large to be reckoned with; move it nearer");
      }
    }
  }

  void read_light() {
    core::PointLight light{.position = vector("l (light)", "a coordinate")};
    check_point(light.position, "l (light)");
    if (tokens_.next_is_number()) {
      light.has_color = true;
      light.color = vector("l (light)", "a colour component");
      check_color(light.color, unbounded, "a colour component of l (light)");
    }
    tokens_.skip_numbers_on_line();
    builder_.light(light);
  }

  void read_material() {
    static constexpr const char* entity = "f (material)";
    core::Material material;
    material.color = vector(entity, "a colour component");
    material.diffuse = tokens_.number(entity, "Kd");
    material.specular = tokens_.number(entity, "Ks");
    material.shine = tokens_.number(entity, "Shine");
    material.transmittance = tokens_.number(entity, "T");
    material.refraction_index = tokens_.number(entity, "the index of refraction");
    check_material(material);
    tokens_.skip_numbers_on_line();
    builder_.material(material);
    has_material_ = true;
  }

  void check_material(const core::Material& material) {
    check_color(material.color, 1, "a colour component of f (material)");
    expect_range(material.diffuse, 0, unbounded, "Kd of f (material)");
    expect_range(material.specular, 0, 1, "Ks of f (material)");
    expect_range(material.shine, 0, unbounded, "Shine of f (material)");
    expect_range(material.transmittance, 0, 1, "T of f (material)");
    if (material.transmittance > 0 && !(material.refraction_index > 0)) {
      tokens_.fail("found " + shortest(material.refraction_index) +
                   " as the index of refraction of f (material) with T above 0, expected a number above 0; give 1 for thin air");
    }
  }

  void read_sphere() {
    const Vec3d center = vector("s (sphere)", "a coordinate of the centre");
    objects().sphere(center, tokens_.number("s (sphere)", "the radius"));
  }

  void read_cone() {
    static constexpr const char* entity = "c (cone or cylinder)";
    const Vec3d base = vector(entity, "a coordinate of the base");
    const double base_radius = tokens_.number(entity, "the base radius");
    const Vec3d apex = vector(entity, "a coordinate of the apex");
    const double apex_radius = tokens_.number(entity, "the apex radius");
    if ((base_radius < 0 && apex_radius > 0) || (base_radius > 0 && apex_radius < 0)) {
      tokens_.fail("found radii " + shortest(base_radius) + " and " + shortest(apex_radius) +
                   " of c (cone or cylinder), expected both 0 or more (outside visible) or both 0 or less (inside visible); "
                   "change a sign");
    }
    objects().cone(base, base_radius, apex, apex_radius);
  }

  void read_polygon() {
    static constexpr const char* entity = "p (polygon)";
    const std::size_t count = vertex_count(entity);
    vertices_.clear();
    while (vertices_.size() < count) {
      vertices_.push_back(vector(entity, "a coordinate of a vertex"));
    }
    objects().polygon(vertices_);
  }

  void read_patch() {
    static constexpr const char* entity = "pp (polygonal patch)";
    const std::size_t count = vertex_count(entity);
    vertices_.clear();
    normals_.clear();
    while (vertices_.size() < count) {
      vertices_.push_back(vector(entity, "a coordinate of a vertex"));
      normals_.push_back(vector(entity, "a component of a normal"));
    }
    objects().patch(vertices_, normals_);
  }

  Vec3d vector(const char* entity, const char* what) {
    const double x = tokens_.number(entity, what);
    const double y = tokens_.number(entity, what);
    return {x, y, tokens_.number(entity, what)};
  }

  std::size_t vertex_count(const char* entity) {
    return static_cast<std::size_t>(tokens_.integer(entity, "the number of vertices", 3, polygon_vertices_max));
  }

  /// The builder, which has a material for what comes.
  core::SceneBuilder& objects() {
    if (!has_material_) {
      core::Material plain;
      plain.color = plain_color;
      builder_.material(plain);
      has_material_ = true;
    }
    return builder_;
  }

  void forbid_second(std::size_t& line, const char* keyword) {
    if (line != 0) {
      tokens_.fail("found a second '" + std::string(keyword) + "' (the first stands on line " + std::to_string(line) +
                   "), expected one at most; remove one");
    }
    line = tokens_.line();
  }

  void expect_range(double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high)) {
      const std::string range = high < unbounded ? "between 0 and 1" : "of 0 or more";
      tokens_.fail("found " + shortest(value) + " as " + what + ", expected a number " + range + "; correct it");
    }
  }

  void check_color(const Vec3d& color, double high, const char* what) {
    for (std::size_t i = 0; i < 3; ++i) {
      expect_range(color[i], 0, high, what);
    }
  }

  NffTokens tokens_;
  core::SceneBuilder builder_;
  std::int64_t pixels_max_;
  bool has_material_ = false;
  std::size_t view_line_ = 0, background_line_ = 0;  ///< 0: not read yet
  std::vector<Vec3d> vertices_, normals_;
};

std::unique_ptr<TextInput> open(const std::string& path) {
  try {
    return std::make_unique<TextInput>(path);
  } catch (const core::InputError& error) {
    throw core::InputError(std::string(error.what()) + "; an NFF scene was expected");
  }
}

}  // namespace

core::Scene read_nff(std::istream& input, const std::string& name, std::int64_t pixels_max) {
  core::Scene scene;
  NffReader(input, name, pixels_max, scene).read({});
  return scene;
}

core::Scene read_nff_file(const std::string& path, std::int64_t pixels_max,
                          const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  const std::unique_ptr<TextInput> input = open(path);
  const std::uint64_t size = input->file_bytes();
  core::Scene scene;
  NffReader(*input, path, pixels_max, scene).read([&progress, size](std::uint64_t bytes) {
    if (progress && bytes <= size) {
      progress(bytes, size);
    }
  });
  return scene;
}

}  // namespace dmpc::apps

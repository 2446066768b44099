#include "apps/lab/oracle/places/place_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "apps/formats/named_file.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/oracle/places/file_places.h"
#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/trial_line.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// Returns the contents of the first of these files that the product has also opened.
std::string bytes_of_opened(const std::vector<fs::path>& meant, const OpenedFiles& opened) {
  constexpr std::uintmax_t bytes_max = std::uintmax_t{1} << 28U;
  for (const fs::path& path : meant) {
    std::error_code error;
    const fs::path resolved = fs::canonical(path, error);
    if (opened.paths().contains(resolved) && fs::is_regular_file(resolved, error) && fs::file_size(resolved) <= bytes_max) {
      std::ifstream file(resolved, std::ios::binary);
      return {std::istreambuf_iterator<char>(file), {}};
    }
  }
  throw core::InputError("a file of it was not opened before, or has more than 256 MiB");
}

void read_places(const PictureOptions& picture, const Resolution& size, const OpenedFiles& opened, FilePlaces& places) {
  const fs::path path = picture.scene;
  const std::string ending = in_small_letters(path.extension().string());
  const double scale = picture.scene_setup.mesh.scale.value_or(1);
  const auto bytes_of = [&](const std::string& name) { return bytes_of_opened(files_meant(path.parent_path(), name), opened); };
  if (picture.scene_setup.mesh.animation || (ending != ".obj" && ending != ".gltf" && ending != ".glb")) {
    throw core::InputError("the oracle reads OBJ and glTF alone, and nothing that moves");
  }
  const std::string bytes = bytes_of_opened({path}, opened);
  ending == ".obj" ? read_obj_places(bytes, scale, places) : read_gltf_places(bytes, bytes_of, scale, size, places);
}

constexpr double ray_beside = 1.0 / 256;  // in pixels
constexpr double place_rounding = 0x1p-49;

struct Spot {
  core::Vec3d point;
  double pixel = 0;  ///< width of a pixel there; 0: the ray hits nothing
  double slack = 0;  ///< distance within which neighbouring rays hit the same surface
};

class FirstHits {
 public:
  FirstHits(const core::Scene& faces, const core::View& view, const Resolution& size)
      : scene_(reference_scene(faces)), camera_(view, size.width, size.height, scene_.bounds), finder_(scene_, camera_.start()) {}

  Spot at(double column, double row) const {
    const ReferenceRay ray = camera_.ray_through(column, row);
    const ReferenceHit hit = finder_.closest(ray);
    if (!hit.found()) {
      return {};
    }
    const ReferenceSurface surface = surface_at(scene_.bodies[hit.body], ray, hit.t);
    const double pixel = narrow_angle(ray) * (ray.cone + hit.t), slant = std::fabs(dot(surface.normal, ray.direction));
    return {surface.point, pixel, pixel * ray_beside * (1 + 1 / slant) + place_rounding * length(surface.point)};
  }

 private:
  ReferenceScene scene_;
  ReferenceCamera camera_;
  ReferenceFinder finder_;
};

/// Returns the difference in pixels; 0 for the same position. If an edge lies so near to the ray that rounding decides which side
/// it passes, a ray beside it sees what was read.
double apart_at(const FirstHits& read, const FirstHits& own, double column, double row) {
  constexpr std::array<std::array<double, 2>, 5> beside{{{0, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};
  const Spot spot = read.at(column, row);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [across, down] : beside) {
    const Spot other = own.at(column + across * ray_beside, row + down * ray_beside);
    const double way = length(spot.point - other.point);
    if ((spot.pixel > 0) == (other.pixel > 0)) {
      least = std::min(least, way <= other.slack ? 0 : way / other.pixel);
    }
    if (least == 0) {
      break;
    }
  }
  return least;
}

}  // namespace

PlaceFindings judge_places(const core::Scene& read, const PictureOptions& picture, const OpenedFiles& opened) {
  const Resolution size = picture.resolution.value_or(Resolution{read.view.width, read.view.height});
  FilePlaces own, product;
  try {
    read_places(picture, size, opened, own);
    for (const core::Object& object : read.objects) {
      const auto corner = read.vertices.begin() + object.first;
      if (object.vertex_count > 0) {
        product.add({corner, corner + object.vertex_count});
      }
    }
  } catch (const std::exception& why) {
    return {.not_judged = why.what()};
  }
  const FirstHits as_read(product.scene, read.view, size);
  const FirstHits as_said(own.scene, own.view && !picture.scene_setup.camera ? *own.view : read.view, size);
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  std::vector<double> apart(width * height);
  side_by_side(height, [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      apart[row * width + column] = apart_at(as_read, as_said, static_cast<double>(column), static_cast<double>(row));
    }
    return [] {};
  });
  const auto worst = std::max_element(apart.begin(), apart.end());
  const auto pixel = static_cast<std::size_t>(worst - apart.begin());
  return {.pixels = apart.size(),
          .elsewhere = apart.size() - static_cast<std::uint64_t>(std::count(apart.begin(), apart.end(), 0.0)),
          .worst = std::isinf(*worst) ? "what one of both does not see" : rounded(*worst) + " pixels off",
          .where = pixel_text(pixel, width)};
}

std::string text_of(const PlaceFindings& findings) {
  const std::string worst = findings.elsewhere == 0 ? "" : " (worst in " + findings.where + ": " + findings.worst + ")";
  return findings.not_judged.empty()
             ? grouped(findings.elsewhere) + " of " + grouped(findings.pixels) + " pixels see another place" + worst
             : "not judged: " + findings.not_judged;
}

}  // namespace dmpc::apps

#include "apps/formats/landscape/files.h"

#include <algorithm>

#include "apps/edge/system/output_file.h"
#include "apps/formats/landscape/gltf.h"
#include "apps/formats/landscape/mesh.h"
#include "apps/formats/landscape/paint.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view family = "landscape";
constexpr int picture_side_max = 4096;

/// The names stand in the file as they are, and other characters would not.
bool is_plain(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

void check_name(const fs::path& gltf) {
  if (gltf.extension() != ".gltf" || !is_plain(gltf.stem().string())) {
    throw core::UsageError(
        "-o " + gltf.string() +
        ": a landscape is written as FILE.gltf, FILE.bin and FILE-ground.png, with letters, digits, - and _ in FILE");
  }
}

}  // namespace

std::optional<int> landscape_size(std::string_view name) {
  if (name.substr(0, family.size()) != family) {
    return std::nullopt;
  }
  for (int size = 1; size <= landscape_size_max; ++size) {
    if (name == std::string(family) + "-" + std::to_string(size)) {
      return size;
    }
  }
  if (name == family) {
    return landscape_size_default;
  }
  throw core::InputError("'" + std::string(name) + "': expected landscape or landscape-N, N from 1 to " +
                         std::to_string(landscape_size_max));
}

std::string describe_landscape() {
  return std::string(family) + " size 1.." + std::to_string(landscape_size_max) + ", default " +
         std::to_string(landscape_size_default) + ": 4^size textured triangles, as FILE.gltf with -o alone\n";
}

void write_landscape(int size, const fs::path& gltf, const RowsDone& rows_done) {
  check_name(gltf);
  fs::path numbers = gltf, picture = gltf;
  numbers.replace_extension(".bin");
  picture.replace_filename(gltf.stem().string() + "-ground.png");  // so that a render to FILE.png leaves it alone
  OutputFile json_file(gltf), numbers_file(numbers), ground_file(picture);
  const LandscapeGltf text =
      landscape_gltf(ground_mesh(size, rows_done), lake_mesh(), numbers.filename().string(), picture.filename().string());
  numbers_file.write(text.numbers);
  ground_file.write(encoded_picture(picture, ground_picture(std::min(picture_side_max, 4 << size), rows_done)));
  json_file.write(text.json);
  ground_file.commit();
  numbers_file.commit();
  json_file.commit();
}

}  // namespace dmpc::apps

#include "apps/formats/landscape/files.h"

#include <algorithm>

#include "apps/formats/landscape/gltf.h"
#include "apps/formats/landscape/grove.h"
#include "apps/formats/landscape/paint.h"
#include "apps/frontend/system/output_file.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

constexpr int picture_side_max = 4096;
/// The ground below trees is this many sizes larger than the grove, up to the second number.
constexpr int ground_beyond_grove = 3, ground_of_grove_max = 10;

/// The size that a name of a family says.
std::optional<int> size_said(std::string_view name, const std::string& family, int size_default, int size_max) {
  if (name.substr(0, family.size()) != family) {
    return std::nullopt;
  }
  for (int size = 1; size <= size_max; ++size) {
    if (name == family + "-" + std::to_string(size)) {
      return size;
    }
  }
  if (name == family) {
    return size_default;
  }
  throw core::InputError("'" + std::string(name) + "': expected " + family + " or " + family + "-N, N from 1 to " +
                         std::to_string(size_max));
}

std::string description(const std::string& family, int size_default, int size_max, const std::string& what) {
  return family + " size 1.." + std::to_string(size_max) + ", default " + std::to_string(size_default) + ": " + what +
         ", written as FILE.gltf with -o\n";
}

/// The names stand in the file as they are, and other characters would not.
bool is_plain(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

void check_name(const fs::path& gltf) {
  if (gltf.extension() != ".gltf" || !is_plain(gltf.stem().string())) {
    throw core::UsageError("-o " + gltf.string() +
                           ": it is written as FILE.gltf, FILE.bin and FILE-ground.png, with letters, digits, - and _ in FILE");
  }
}

/// A landscape of 4^size triangles, with trees or without.
void write(int size, const Grove* trees, const fs::path& gltf, const RowsDone& rows_done) {
  check_name(gltf);
  fs::path numbers = gltf, picture = gltf;
  numbers.replace_extension(".bin");
  picture.replace_filename(gltf.stem().string() + "-ground.png");  // so that a render to FILE.png leaves it alone
  OutputFile json_file(gltf), numbers_file(numbers), ground_file(picture);
  const LandscapeGltf text =
      landscape_gltf(ground_mesh(size, rows_done), lake_mesh(), numbers.filename().string(), picture.filename().string(), trees);
  numbers_file.write(text.numbers);
  ground_file.write(encoded_picture(picture, ground_picture(ground_picture_side(size), rows_done)));
  json_file.write(text.json);
  ground_file.commit();
  numbers_file.commit();
  json_file.commit();
}

}  // namespace

std::optional<int> landscape_size(std::string_view name) {
  return size_said(name, "landscape", landscape_size_default, landscape_size_max);
}

std::optional<int> grove_size(std::string_view name) { return size_said(name, "grove", grove_size_default, grove_size_max); }

int ground_size(int grove_size) { return std::min(grove_size + ground_beyond_grove, ground_of_grove_max); }

int ground_picture_side(int size) { return std::min(picture_side_max, 4 << size); }

std::string describe_landscape() {
  return description("landscape", landscape_size_default, landscape_size_max, "4^size textured triangles") +
         description("grove", grove_size_default, grove_size_max, "up to 2*4^size trees of 2,048 triangles on a landscape");
}

void write_landscape(int size, const fs::path& gltf, const RowsDone& rows_done) { write(size, nullptr, gltf, rows_done); }

void write_grove(int size, const fs::path& gltf, const RowsDone& rows_done) {
  check_name(gltf);
  const Grove trees = grove(size);
  write(ground_size(size), &trees, gltf, rows_done);
}

}  // namespace dmpc::apps

#include "apps/lab/oracle/accurate/reference_file.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/edge/system/output_file.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path picture_file(const fs::path& folder, const std::string& key) { return folder / (key + ".exr"); }
fs::path figures_file(const fs::path& folder, const std::string& key) { return folder / (key + ".json"); }

/// A hash of the size and all bits.
std::uint64_t hash_of(const Image& image) {
  std::uint64_t hash = core::mix(static_cast<std::uint64_t>(image.width) << 32U | static_cast<std::uint64_t>(image.height));
  for (const float value : image.rgb) {
    hash = core::mix(hash * 0x9e3779b97f4a7c15ULL + std::bit_cast<std::uint32_t>(value));
  }
  return hash;
}

json figures_of(const std::string& key, const Reference& reference) {
  return {{"key", key},
          {"picture_hash", hash_of(reference.picture)},
          {"own_error", reference.own_error},
          {"own_relative_mean_square", reference.own_relative_mean_square},
          {"rays", reference.rays},
          {"seconds", reference.seconds}};
}

/// Throws whatever comes if something is missing or wrong.
Reference read_reference(const fs::path& folder, const std::string& key) {
  std::ifstream text(figures_file(folder, key));
  const json figures = json::parse(text);
  Reference reference;
  reference.picture = read_image(picture_file(folder, key));
  reference.own_error = figures.at("own_error").get<double>();
  reference.own_relative_mean_square = figures.at("own_relative_mean_square").get<double>();
  reference.rays = figures.at("rays").get<std::uint64_t>();
  reference.seconds = figures.at("seconds").get<double>();
  reference.from_cache = true;
  core::expect(figures.at("key") == key && figures.at("picture_hash") == hash_of(reference.picture),
               "a kept picture belongs to its figures");
  core::expect(reference.own_error >= 0 && std::isfinite(reference.own_error), "an error is a number");
  return reference;
}

}  // namespace

std::optional<Reference> load_reference(const fs::path& folder, const std::string& key) {
  std::error_code error;
  if (!fs::exists(figures_file(folder, key), error) || !fs::exists(picture_file(folder, key), error)) {
    return std::nullopt;
  }
  try {
    return read_reference(folder, key);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void make_reference_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);  // what went wrong shows below
  make_output_folder(folder, "the folder of references");
}

void save_reference(const fs::path& folder, const std::string& key, const Reference& reference, Files& files) {
  const fs::path picture = picture_file(folder, key);
  write_file(picture, encoded_picture(picture, reference.picture), Durability::on_disk, files);
  write_file(figures_file(folder, key), figures_of(key, reference).dump(2) + "\n", Durability::on_disk, files);
}

}  // namespace dmpc::apps

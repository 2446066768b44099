// The built-in generators against files made by the SPD's own, which are no part of the project: a folder beside it, or the one
// that DMPC_REFERENCE_NFF names.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/formats/nff_writer.h"
#include "core/families/scenes.h"

namespace reference_files_test {

using namespace dmpc;

namespace {

std::filesystem::path reference_folder() {
  const char* given = std::getenv("DMPC_REFERENCE_NFF");
  return given != nullptr ? std::filesystem::path(given) : std::filesystem::path(DMPC_SOURCE_DIR) / "../shared/nff";
}

std::vector<std::filesystem::path> reference_files() {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(reference_folder(), error)) {
    if (entry.path().extension() == ".nff") {
      files.push_back(entry.path());
    }
  }
  return files;
}

/// Half a unit of the 6th significant digit of `y`, and a little for values that should be 0.
double tolerance(double y) { return y == 0 ? 1e-12 : 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(y))) - 5) + 1e-12; }

bool same_token(const std::string& ours, const std::string& theirs) {
  char* end = nullptr;
  const double y = std::strtod(theirs.c_str(), &end);
  if (end == theirs.c_str()) {
    return ours == theirs;
  }
  const double x = std::strtod(ours.c_str(), &end);
  return end != ours.c_str() && *end == '\0' && std::abs(x - y) <= tolerance(y);
}

struct TokenComparison {
  std::size_t tokens = 0, differences = 0;
  std::string first_difference;
};

/// Token by token in file order; a missing or surplus token is a difference.
TokenComparison compare(std::istream& ours, std::istream& theirs) {
  TokenComparison result;
  std::string x, y;
  while (true) {
    const bool has_ours = static_cast<bool>(ours >> x), has_theirs = static_cast<bool>(theirs >> y);
    if (!has_ours && !has_theirs) {
      return result;
    }
    ++result.tokens;
    if (has_ours != has_theirs || !same_token(x, y)) {
      if (result.differences++ == 0) {
        result.first_difference = "token " + std::to_string(result.tokens) + ": '" + x + "' against '" + y + "'";
      }
      if (has_ours != has_theirs) {
        return result;
      }
    }
  }
}

TokenComparison compare_with_file(const std::filesystem::path& path) {
  std::stringstream ours;
  apps::NffWriter writer(ours);
  core::generate_unrounded_scene(core::parse_scene_name(path.stem().string()), writer);
  std::ifstream theirs(path);
  return compare(ours, theirs);
}

/// FNV-1a (Fowler, Noll, Vo).
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

struct KnownHash {
  const char* name;
  std::uint64_t hash;
};

}  // namespace

TEST_CASE("the comparison of token streams finds a number, a keyword and a length that differ") {
  const auto differences = [](const char* ours, const char* theirs) {
    std::istringstream x(ours), y(theirs);
    return compare(x, y).differences;
  };
  CHECK(differences("s 0.123456 -0 1e-17", "s 0.123456 0 5.14e-18") == 0);
  CHECK(differences("s 0.123457", "s 0.123456") == 1);
  CHECK(differences("s 1e-11", "s 0") == 1);
  CHECK(differences("pp 3", "p 3") == 1);
  CHECK(differences("s 1x", "s 1") == 1);
  CHECK(differences("s 1", "s 1 2") == 1);
  CHECK(differences("s 1 2", "s 1") == 1);
}

TEST_CASE("the generators reproduce the reference files number for number in file order, where the files are there") {
  const std::vector<std::filesystem::path> files = reference_files();
  if (files.empty()) {
    MESSAGE("SKIPPED: no reference files in ", reference_folder().string(),
            " (set DMPC_REFERENCE_NFF to the folder of the SPD's own files), so nothing was compared");
    return;
  }
  for (const std::filesystem::path& file : files) {
    const TokenComparison result = compare_with_file(file);
    CAPTURE(file.string());
    CAPTURE(result.first_difference);
    CHECK(result.tokens > 100);
    CHECK(result.differences == 0);
  }
  MESSAGE("compared ", files.size(), " reference files");
}

TEST_CASE("the written scenes are the same bytes on every machine and in every build") {
  const std::vector<KnownHash> scenes = {
      {"balls-3", 0xf619e4adbdafe379},    {"gears-2", 0xa1c5c0349b5bb361},    {"jacks-2", 0x90822eda4da64878},
      {"jacks-2-t2", 0x0b66bca71c9ed96b}, {"lattice-3", 0x0044db31a832e859},  {"mount-5", 0xf9de36feab0b45c0},
      {"mount-3-t6", 0x8c63f6e28bb51003}, {"rings-2", 0xadf50da73fe2a86f},    {"rings-2-t1", 0xad54c20ddeaa5a4e},
      {"shells-2", 0x79be53187b6203d8},   {"sombrero-1", 0xbe9f3152380d8d0d}, {"teapot-6", 0x11e82790efbe043f},
      {"tetra-5", 0xb7f32354b90e7cd2},    {"tree-6", 0xbc96567e295fcff7},     {"tree-3-t4", 0xe5ae896be7a3df98},
  };
  for (const KnownHash& scene : scenes) {
    std::ostringstream output;
    apps::NffWriter writer(output);
    core::generate_scene(core::parse_scene_name(scene.name), writer);
    CAPTURE(std::string(scene.name));
    CHECK(hash_of(output.str()) == scene.hash);
  }
}

}  // namespace reference_files_test
